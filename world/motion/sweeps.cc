#include "world/motion/sweeps.h"

#include <atomic>
#include <cmath>
#include <cstring>

#include "base/parallel.h"
#include "world/motion/bounding_radii.h"
#include "world/motion/inner_diameter.h"
#include "world/store/columns.h"
#include "world/store/row_blocks.h"

namespace carom {
namespace {

using Eigen::Vector3f;

Vector3f motion_in(const Vector3f& velocity, double dt) {
  Vector3f motion;
  for (int axis = 0; axis < 3; ++axis) {
    motion[axis] = static_cast<float>(double{velocity[axis]} * dt);
  }
  return motion;
}

double length(const Vector3f& v) {
  const double x = v.x(), y = v.y(), z = v.z();
  return std::sqrt((x * x + y * y) + z * z);
}

// A bound on how far any point of the body moves.
double way_of(const Sweep& sweep, const BodyReader& reader, uint32_t index) {
  const double angle = length(sweep.rotation);
  const double turned = angle > 0 ? angle * double{bounding_radius(reader, index)} : 0;
  return length(sweep.displacement) + turned;
}

bool is_fast(const Sweep& sweep, const BodyReader& reader, uint32_t index, float share) {
  if (sweep.displacement.isZero(0) && sweep.rotation.isZero(0)) return false;
  if (reader.kind(index) == ShapeKind::halfspace) return false;
  return way_of(sweep, reader, index) > double{share} * inner_diameter(reader, index);
}

bool is_same(const Vector3f& a, const Vector3f& b) {
  return std::memcmp(a.data(), b.data(), sizeof a) == 0;
}

}  // namespace

Sweeps::Mode Sweeps::mode_of(Detection detection) {
  switch (detection) {
    case Detection::swept:
      return Mode::swept;
    case Detection::continuous:
      return Mode::continuous;
    default:
      return Mode::discrete;
  }
}

Sweeps::Row Sweeps::row_of(const BodyStore& bodies, const Collidables& view, uint32_t index,
                           double dt, float fast_share) {
  if (!bodies.is_alive(index)) return {};
  const BodyReader reader{view};
  Sweep sweep{.displacement = motion_in(bodies.linear_velocity(index), dt)};
  if (row_count(reader.kind(index)) > 0) {
    sweep.rotation = motion_in(bodies.angular_velocity(index), dt);
  }
  if (!sweep.displacement.allFinite() || !sweep.rotation.allFinite()) return {{}, Mode::unknown};
  const Detection detection = bodies.detection(index);
  const bool is_fast_now =
      detection == Detection::automatic && is_fast(sweep, reader, index, fast_share);
  return {sweep, is_fast_now ? Mode::continuous : mode_of(detection)};
}

void Sweeps::store(uint32_t index, const Row& row, Counts& counts) {
  counts.changed |= row.mode != mode_[index] ||
                    !is_same(row.sweep.displacement, displacement_[index]) ||
                    (!rotation_.empty() && !is_same(row.sweep.rotation, rotation_[index]));
  mode_[index] = row.mode;
  displacement_[index] = row.sweep.displacement;
  if (!rotation_.empty()) rotation_[index] = row.sweep.rotation;
  counts.swept += row.mode >= Mode::swept;
  counts.continuous += row.mode == Mode::continuous;
  counts.unswept += row.mode == Mode::unknown;
}

void Sweeps::update(const BodyStore& bodies, double dt, float fast_share, Parallelism parallelism) {
  const size_t rows = bodies.rows();
  mode_.resize(rows, Mode::discrete);
  displacement_.resize(rows, Vector3f::Zero());
  rotation_.resize(bodies.has_angular_velocities() ? rows : 0, Vector3f::Zero());
  const Collidables view = bodies.view();
  std::atomic<size_t> swept{0}, continuous{0}, unswept{0};
  std::atomic<bool> changed{false};
  for_each_block(rows, kRowsPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    Counts counts;
    for (size_t i = begin; i < end; ++i) {
      const auto index = static_cast<uint32_t>(i);
      store(index, row_of(bodies, view, index, dt, fast_share), counts);
    }
    swept += counts.swept;
    continuous += counts.continuous;
    unswept += counts.unswept;
    if (counts.changed) changed = true;
  });
  swept_ = swept;
  continuous_ = continuous;
  unswept_ = unswept;
  changed_ = changed || dt != dt_;
  dt_ = dt;
}

Sweep Sweeps::sweep(uint32_t index) const {
  return {displacement_[index], rotation_.empty() ? Vector3f::Zero().eval() : rotation_[index]};
}

SweepView Sweeps::view() const {
  SweepView view;
  if (!displacement_.empty()) view.displacement = displacement_.front().data();
  if (!rotation_.empty()) view.rotation = rotation_.front().data();
  return view;
}

size_t Sweeps::bytes() const {
  return bytes_of(mode_) + bytes_of(displacement_) + bytes_of(rotation_);
}

}  // namespace carom
