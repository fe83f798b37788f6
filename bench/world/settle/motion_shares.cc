#include "bench/world/settle/motion_shares.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "shapes/body_reader.h"
#include "world/motion/bounding_radii.h"

namespace carom::bench {
namespace {

constexpr float kDistances[] = {1e-5f, 1e-4f, 3e-4f, 1e-3f};  // metres

float turning_radius_of(const Shape& shape) {
  const ShapeKind kind = kind_of(shape);
  if (row_count(kind) == 0) return 0;
  const auto rows = shape_rows(shape);
  Collidables body;
  body.count = 1;
  body.uniform_kind = kind;
  body.rows.data = rows[0].data();
  const BodyReader reader{body};
  return turning_radius(reader, 0, bounding_radius(reader, 0));
}

Pose pose_of(const World& world, BodyId id) { return {world.position(id), world.orientation(id)}; }

float motion(const Pose& from, const Pose& to, float turn_radius) {
  const Eigen::Quaterniond turn =
      to.orientation.cast<double>() * from.orientation.cast<double>().conjugate();
  const double angle = 2 * std::atan2(turn.vec().norm(), std::fabs(turn.w()));
  return static_cast<float>((to.position - from.position).norm() + turn_radius * angle);
}

float deepest_overlap(const World& world) {
  float deepest = 0;
  for (const Contact& contact : world.contacts()) {
    deepest = std::max(deepest, -contact.separation);
  }
  return deepest;
}

}  // namespace

MotionShares::MotionShares(const Heap& heap) : heap_(heap) {
  for (const BodyId id : heap.moving()) {
    turn_radius_.push_back(turning_radius_of(heap.world().shape(id)));
  }
}

void MotionShares::start() {
  poses_.clear();
  for (const BodyId id : heap_.moving()) poses_.push_back(pose_of(heap_.world(), id));
}

std::vector<float> MotionShares::sorted_motions() const {
  std::vector<float> motions;
  for (size_t i = 0; i < poses_.size(); ++i) {
    motions.push_back(
        motion(poses_[i], pose_of(heap_.world(), heap_.moving()[i]), turn_radius_[i]));
  }
  std::sort(motions.begin(), motions.end());
  return motions;
}

void MotionShares::print(int frame) const {
  const std::vector<float> motions = sorted_motions();
  if (motions.empty()) return;
  std::printf("frame %d: moved more than", frame);
  for (const float distance : kDistances) {
    const auto more = motions.end() - std::upper_bound(motions.begin(), motions.end(), distance);
    const double share = static_cast<double>(more) / static_cast<double>(motions.size());
    std::printf(" %.0e m: %.1f %%,", static_cast<double>(distance), 100 * share);
  }
  std::printf(" median %.1e m, most %.1e m; contacts %zu, deepest overlap %.1e m\n",
              static_cast<double>(motions[motions.size() / 2]), static_cast<double>(motions.back()),
              heap_.world().contacts().size(), static_cast<double>(deepest_overlap(heap_.world())));
  std::fflush(stdout);
}

}  // namespace carom::bench
