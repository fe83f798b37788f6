// Bodies -> world bounds.
#include <cmath>
#include <variant>

#include "base/float_environment.h"
#include "carom/reference/reference.h"
#include "reference/exact_sum.h"
#include "reference/turned_extent.h"
#include "reference/vectors.h"
#include "shapes/dop_geometry.h"

namespace carom::reference {
namespace {

// Corners relative to the position.
Aabb extent(const Sphere& sphere, const Eigen::Quaternionf&) {
  return Aabb::from_half_extents(Eigen::Vector3f::Constant(sphere.radius));
}
Aabb extent(const Aabb& box, const Eigen::Quaternionf&) { return box; }
template <class Turned>
Aabb extent(const Turned& shape, const Eigen::Quaternionf& orientation) {
  return turned_extent(shape, orientation);
}

template <class Real>
Box bounds_at(const Aabb& extent, const Eigen::Vector3<Real>& position) {
  Box box;
  for (int i = 0; i < 3; ++i) {
    box.lower[i] = sum_down<Real>(position[i], extent.lower[i]);
    box.upper[i] = sum_up<Real>(position[i], extent.upper[i]);
  }
  return box;
}

bool is_size(float x) { return std::isfinite(x) && x >= 0; }

bool is_valid_body(const Sphere& sphere, const Eigen::Quaternionf&) {
  return is_size(sphere.radius);
}

bool is_valid_body(const Aabb& box, const Eigen::Quaternionf&) {
  return box.lower.allFinite() && box.upper.allFinite() &&
         (box.lower.array() <= box.upper.array()).all();
}

bool is_valid_shape(const Capsule& c) {
  return c.a.allFinite() && c.b.allFinite() && is_size(c.radius);
}
bool is_valid_shape(const carom::Box& box) {
  return box.half.allFinite() && (box.half.array() >= 0).all() && is_size(box.rounding);
}
bool is_valid_shape(const Cylinder& c) {
  return is_size(c.radius) && is_size(c.half_length) && is_size(c.rounding);
}
bool is_valid_shape(const Cone& c) {
  return is_size(c.radius) && is_size(c.half_length) && is_size(c.rounding);
}
bool is_valid_shape(const Ellipsoid& e) {
  return e.semi_axes.allFinite() && (e.semi_axes.array() >= 0).all() && is_size(e.rounding);
}
bool is_valid_shape(const Triangle& t) {
  return t.corners[0].allFinite() && t.corners[1].allFinite() && t.corners[2].allFinite() &&
         is_size(t.thickness) && t.inner_edges <= 7;
}
bool is_valid_shape(const Halfspace& h) {
  return h.normal.allFinite() && std::isfinite(h.offset) && !h.normal.isZero(0);
}
bool is_valid_shape(const Dop& dop) {
  if (!is_dop_kind(dop.kind)) return false;
  for (size_t i = 0; i < slab_count(dop.kind); ++i) {
    const bool is_finite = std::isfinite(dop.lower[i]) && std::isfinite(dop.upper[i]);
    if (!is_finite || dop.lower[i] > dop.upper[i]) return false;
  }
  return known_geometry(dop) || has_points(DopSlabs(dop));
}

bool is_valid_shape(const Hull& hull) { return hull.geometry != nullptr && is_size(hull.rounding); }
bool is_valid_shape(const Mesh& mesh) { return mesh.geometry != nullptr; }
bool is_valid_shape(const HeightField& field) { return field.geometry != nullptr; }
bool is_valid_shape(const Compound& compound) { return compound.geometry != nullptr; }

template <class Turned>
bool is_valid_body(const Turned& shape, const Eigen::Quaternionf& orientation) {
  const Eigen::Vector4f& q = orientation.coeffs();
  return q.allFinite() && !q.isZero(0) && is_valid_shape(shape);
}

}  // namespace

bool is_valid(const Shape& shape, const Pose& pose, PositionType positions) {
  const FloatEnvironment environment;
  const bool is_finite = positions == PositionType::float32
                             ? pose.position.cast<float>().allFinite()
                             : pose.position.allFinite();
  return is_finite &&
         std::visit([&](const auto& s) { return is_valid_body(s, pose.orientation); }, shape);
}

Box bounds(const Shape& shape, const Pose& pose, PositionType positions) {
  const FloatEnvironment environment;
  if (!is_valid(shape, pose, positions)) {
    return {Eigen::Vector3f::Constant(kInfinity), Eigen::Vector3f::Constant(-kInfinity)};
  }
  if (std::holds_alternative<Halfspace>(shape)) {
    return {Eigen::Vector3f::Constant(-kInfinity), Eigen::Vector3f::Constant(kInfinity)};
  }
  const Aabb corners =
      std::visit([&](const auto& s) { return extent(s, pose.orientation); }, shape);
  if (positions == PositionType::float32) {
    return bounds_at<float>(corners, pose.position.cast<float>());
  }
  return bounds_at<double>(corners, pose.position);
}

}  // namespace carom::reference
