// Pairs of bodies to test.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "carom/kernel/body.h"
#include "carom/reference/reference.h"

namespace carom::test {

struct PlacedShape {
  Shape shape;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

struct TestPair {
  PlacedShape a;
  PlacedShape b;
};

inline TestPair swapped(const TestPair& pair) { return {pair.b, pair.a}; }

inline PlacedShape sphere(double x, double y, double z, double radius) {
  return {Sphere{static_cast<float>(radius)}, {x, y, z}};
}

// A box of these half extents.
inline PlacedShape box(const Eigen::Vector3d& position, const Eigen::Vector3f& half) {
  return {Aabb::from_half_extents(half), position};
}

inline reference::PairResult reference_result(const TestPair& pair, PositionType positions) {
  return reference::collide(pair.a.shape, pair.a.position, pair.b.shape, pair.b.position,
                            positions);
}

// The position as it is stored.
inline Eigen::Vector3d stored(const Eigen::Vector3d& position, PositionType positions) {
  if (positions == PositionType::float64) return position;
  return position.cast<float>().cast<double>();
}

inline const char* name(PositionType positions) {
  return positions == PositionType::float32 ? "float32" : "float64";
}

inline constexpr PositionType kPositionTypes[] = {PositionType::float32, PositionType::float64};

}  // namespace carom::test
