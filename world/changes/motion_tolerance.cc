#include "world/changes/motion_tolerance.h"

#include <cmath>

#include "base/parallel.h"
#include "shapes/body_reader.h"
#include "shapes/turn.h"
#include "world/store/row_blocks.h"

namespace carom {
namespace {

// A generous bound on the rounding of the sums, products and roots below.
constexpr double kRounding = 0x1p-44;

double squared(const BodyStore::Row& q) {
  return dot(vector_of(q), vector_of(q)) + double{q[3]} * q[3];
}

// The squared length of the vector part of conj(p) q. The length is |p| |q| times the sine of half
// the angle between the two rotations, and the same for q and -q.
double squared_turn(const BodyStore::Row& p, const BodyStore::Row& q) {
  const Double3 u = vector_of(p), v = vector_of(q);
  const double pw = p[3], qw = q[3];
  const Double3 part = {pw * v[0] - qw * u[0] - (u[1] * v[2] - u[2] * v[1]),
                        pw * v[1] - qw * u[1] - (u[2] * v[0] - u[0] * v[2]),
                        pw * v[2] - qw * u[2] - (u[0] * v[1] - u[1] * v[0])};
  return dot(part, part);
}

// The orientation; the identity for spheres and aabbs, which do not turn.
BodyStore::Row turn_of(const BodyReader& reader, size_t i) {
  return row_count(reader.kind(i)) > 0 ? reader.orientation(i) : BodyStore::kIdentity;
}

}  // namespace

// Whether no point of the body moves by more than `distance`. The bound is the displacement of the
// position plus the chord of a point at the bounding radius. False if a number is NaN, or a
// quaternion is no rotation.
bool MotionTolerance::stays_within(double distance, const Pose& from, const Pose& to) {
  const Double3 way = minus(to.position, from.position);
  const double left = distance * (1 - kRounding) - std::sqrt(dot(way, way)) * (1 + kRounding);
  if (from.orientation == to.orientation) return left >= 0;
  const double radius = to.radius;
  const double chord = left - radius * kRounding;
  return chord > 0 && 4 * (radius * radius) * squared_turn(from.orientation, to.orientation) <
                          chord * chord * (squared(from.orientation) * squared(to.orientation));
}

std::span<const uint8_t> MotionTolerance::update(const BodyStore& bodies,
                                                 const ChangeTracker& changes,
                                                 std::span<const float> radii, float tolerance,
                                                 Parallelism parallelism) {
  references_.resize(bodies.rows());  // new bodies are touched
  exceeded_.resize(bodies.rows());
  const Collidables view = bodies.view();
  const BodyReader reader{view};
  const double half = 0.5 * double{tolerance};
  for_each_block(bodies.rows(), kRowsPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const auto index = static_cast<uint32_t>(i);
      exceeded_[i] = 0;
      if (!changes.changed(index)) continue;
      const auto p = reader.position<double>(i);
      const Pose pose = {{p.x, p.y, p.z}, turn_of(reader, i), radii[i]};
      Pose& reference = references_[i];
      const bool is_same_shape =
          !bodies.touched(index) && !changes.reshaped(view, i) && reference.radius == pose.radius;
      if (is_same_shape && stays_within(half, reference, pose)) continue;
      reference = pose;
      exceeded_[i] = 1;
    }
  });
  return exceeded_;
}

}  // namespace carom
