// Pairs of bodies to test.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <string>
#include <vector>

#include "carom/reference/reference.h"
#include "carom/shapes/body.h"
#include "carom/shapes/views.h"

namespace carom::test {

struct PlacedShape {
  Shape shape;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();

  Pose pose() const { return {position, orientation}; }
};

struct TestPair {
  PlacedShape a;
  PlacedShape b;
};

inline TestPair swapped(const TestPair& pair) { return {pair.b, pair.a}; }

inline PlacedShape sphere(double x, double y, double z, double radius) {
  return {Sphere{static_cast<float>(radius)}, {x, y, z}};
}

// A box along the axes with these half extents.
inline PlacedShape box(const Eigen::Vector3d& position, const Eigen::Vector3f& half) {
  return {Aabb::from_half_extents(half), position};
}

inline PlacedShape oriented_box(
    const Eigen::Vector3d& position, const Eigen::Vector3f& half,
    const Eigen::Quaternionf& orientation = Eigen::Quaternionf::Identity()) {
  return {Box{half}, position, orientation};
}

inline PlacedShape capsule(const Eigen::Vector3d& position, const Eigen::Vector3f& a,
                           const Eigen::Vector3f& b, float radius) {
  return {Capsule{a, b, radius}, position};
}

inline PlacedShape triangle(const Eigen::Vector3d& position,
                            const std::array<Eigen::Vector3f, 3>& corners) {
  Triangle triangle;
  triangle.corners = corners;
  return {triangle, position};
}

inline PlacedShape halfspace(const Eigen::Vector3d& position, const Eigen::Vector3f& normal,
                             float offset) {
  return {Halfspace{normal, offset}, position};
}

// Whether a body of this kind has rows of parameters and an orientation.
inline bool has_rows(const Shape& shape) { return row_count(kind_of(shape)) > 0; }

inline reference::PairResult reference_result(const TestPair& pair, PositionType positions) {
  return reference::collide(pair.a.shape, pair.a.pose(), pair.b.shape, pair.b.pose(), positions);
}

// The position after rounding to the stored type.
inline Eigen::Vector3d stored(const Eigen::Vector3d& position, PositionType positions) {
  if (positions == PositionType::float64) return position;
  return position.cast<float>().cast<double>();
}

inline const char* name(PositionType positions) {
  return positions == PositionType::float32 ? "float32" : "float64";
}

inline constexpr PositionType kPositionTypes[] = {PositionType::float32, PositionType::float64};
inline constexpr auto kFloat32 = PositionType::float32;

}  // namespace carom::test
