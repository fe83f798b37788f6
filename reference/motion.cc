#include "reference/motion.h"

#include <cmath>
#include <limits>

#include "base/float_environment.h"
#include "reference/exact_sum.h"
#include "reference/shape_sizes.h"
#include "reference/vectors.h"

namespace carom::reference {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

Vector3f over_interval(const Vector3f& velocity, double dt) {
  return (velocity.cast<double>() * dt).cast<float>();
}

// Whether a point of the body may move further than this share of the diameter of a ball inside it.
bool is_fast(const BodyDesc& body, const Sweep& sweep, float share) {
  if (kind_of(body.shape) == ShapeKind::halfspace) return false;
  const double angle = norm(sweep.rotation);
  const double turned = angle > 0 ? angle * bounding_radius(body.shape) : 0;
  const double way = norm(sweep.displacement) + turned;
  return way > 0 && way > double{share} * inner_diameter(body.shape);
}

// A box that holds the body while it turns in place: the intersection of the box of the ball about
// its position with the present box grown by the greatest distance that a point moves.
Box turned_box(const Box& now, const BodyDesc& body, const Vector3f& rotation,
               PositionType positions) {
  const float radius = bounding_radius(body.shape);
  if (radius > std::numeric_limits<float>::max() / 2) {
    return {Vector3f::Constant(-kInfinity), Vector3f::Constant(kInfinity)};
  }
  const double angle = norm(rotation) * (1 + 0x1p-40);
  const double furthest = std::fmin(angle, 2) * radius;
  auto way = static_cast<float>(furthest);
  if (way < furthest) way = step_up(way);
  Vector3d position = body.position;
  if (positions == PositionType::float32) position = position.cast<float>().cast<double>();
  const double reach = radius;
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    box.lower[axis] = std::fmax(sum_down(now.lower[axis], -way), sum_down(position[axis], -reach));
    box.upper[axis] = std::fmin(sum_up(now.upper[axis], way), sum_up(position[axis], reach));
  }
  return box;
}

}  // namespace

BodyMotion motion_of(const BodyDesc& body, const Ahead& ahead) {
  const FloatEnvironment environment;
  BodyMotion motion;
  motion.sweep.displacement = over_interval(body.linear_velocity, ahead.dt);
  if (row_count(kind_of(body.shape)) > 0) {
    motion.sweep.rotation = over_interval(body.angular_velocity, ahead.dt);
  }
  if (!motion.sweep.displacement.allFinite() || !motion.sweep.rotation.allFinite()) {
    return {.sweep = {}, .is_finite = false};
  }
  motion.detection = body.detection;
  if (body.detection == Detection::automatic) {
    const bool fast = is_fast(body, motion.sweep, ahead.fast_share);
    motion.detection = fast ? Detection::continuous : Detection::discrete;
  }
  return motion;
}

Box box_over(const Box& now, const BodyDesc& body, const Sweep& sweep, PositionType positions) {
  const FloatEnvironment environment;
  Box box = now;
  if (!sweep.rotation.isZero(0)) box = turned_box(now, body, sweep.rotation, positions);
  for (int axis = 0; axis < 3; ++axis) {
    const float way = sweep.displacement[axis];
    if (way < 0) box.lower[axis] = sum_down(box.lower[axis], way);
    if (way > 0) box.upper[axis] = sum_up(box.upper[axis], way);
  }
  return box;
}

Plane plane_over(const Plane& now, const Sweep& sweep) {
  const FloatEnvironment environment;
  Plane plane = now;
  const Vector3d d = sweep.displacement.cast<double>();
  if (!sweep.rotation.isZero(0)) {
    plane.limit = kInfinity;
  } else if (!d.isZero(0)) {
    const Vector3d& n = now.normal;
    const double along = (n.x() * d.x() + n.y() * d.y()) + n.z() * d.z();
    const double error = now.slack * ((std::abs(d.x()) + std::abs(d.y())) + std::abs(d.z()));
    plane.limit = std::nextafter(now.limit + std::fmax(along + error, 0), kInfinity);
  }
  return plane;
}

}  // namespace carom::reference
