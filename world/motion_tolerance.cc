#include "world/motion_tolerance.h"

#include <cmath>

#include "kernel/parallel.h"
#include "kernel/turn.h"

namespace carom {
namespace {

constexpr size_t kRowsPerBlock = 1024;

// What the sums and roots below round at most, generously.
constexpr double kRounding = 0x1p-45;

double squared(const BodyStore::Row& q) {
  return dot(vector_of(q), vector_of(q)) + double{q[3]} * q[3];
}

// At least the sine of half the angle from one rotation to the other: the length of the vector part
// of conj(p) q, which is the same for q and -q. Not a number where one of them is no rotation.
double half_angle_sine(const BodyStore::Row& p, const BodyStore::Row& q) {
  const Double3 u = vector_of(p), v = vector_of(q);
  const double pw = p[3], qw = q[3];
  const Double3 part = {pw * v[0] - qw * u[0] - (u[1] * v[2] - u[2] * v[1]),
                        pw * v[1] - qw * u[1] - (u[2] * v[0] - u[0] * v[2]),
                        pw * v[2] - qw * u[2] - (u[0] * v[1] - u[1] * v[0])};
  return std::sqrt(dot(part, part) / (squared(p) * squared(q))) + kRounding;
}

}  // namespace

MotionTolerance::Pose MotionTolerance::pose_of(const BodyStore& bodies,
                                               std::span<const float> radii, uint32_t index) {
  const Eigen::Vector3d p = bodies.position(index);
  const Eigen::Quaternionf q = bodies.orientation(index);
  return {{p.x(), p.y(), p.z()}, {q.x(), q.y(), q.z(), q.w()}, radii[index]};
}

// The way that the position goes, and the chord of a point as far away from it as any.
double MotionTolerance::most_motion(const Pose& from, const Pose& to) {
  const Double3 way = minus(to.position, from.position);
  double most = std::sqrt(dot(way, way));
  if (from.orientation != to.orientation) {
    most += 2 * half_angle_sine(from.orientation, to.orientation) * to.radius;
  }
  return most * (1 + kRounding);
}

std::span<const uint8_t> MotionTolerance::update(const BodyStore& bodies,
                                                 const ChangeTracker& changes,
                                                 std::span<const float> radii, float tolerance,
                                                 Parallelism parallelism) {
  resize_and_give_back(references_, bodies.rows());  // bodies that are new are touched
  resize_and_give_back(exceeded_, bodies.rows());
  const Collidables view = bodies.view();
  const double half = 0.5 * double{tolerance};
  for_each_block(bodies.rows(), kRowsPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const auto index = static_cast<uint32_t>(i);
      exceeded_[i] = 0;
      if (!changes.changed(index)) continue;
      const Pose pose = pose_of(bodies, radii, index);
      Pose& reference = references_[i];
      const bool is_same_shape =
          !bodies.touched(index) && !changes.reshaped(view, i) && reference.radius == pose.radius;
      if (is_same_shape && most_motion(reference, pose) <= half) continue;
      reference = pose;
      exceeded_[i] = 1;
    }
  });
  return exceeded_;
}

}  // namespace carom
