// Hulls of simple form.
#pragma once

#include <numbers>
#include <vector>

#include "oracle/hull_faces.h"
#include "oracle/random.h"
#include "tests/support/pairs.h"

namespace carom::test {

using Points = std::vector<Eigen::Vector3f>;

inline PlacedShape placed_hull(const Points& points,
                               const Eigen::Vector3d& position = Eigen::Vector3d::Zero(),
                               const Eigen::Quaternionf& turn = Eigen::Quaternionf::Identity()) {
  return {oracle::hull_of(points), position, turn};
}

inline Points points_of(const Hull& hull) {
  return {hull.geometry->points().begin(), hull.geometry->points().end()};
}

inline Points box_corners(const Eigen::Vector3f& half) {
  Points corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back(
        Eigen::Vector3f(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1).cwiseProduct(half));
  }
  return corners;
}

inline Points cube_corners(float half = 1) { return box_corners(Eigen::Vector3f::Constant(half)); }

// A square at z = 0 with sides of 2, and an apex above it.
inline Points pyramid(float height) {
  return {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, height}};
}

// A prism about the z axis, from -half_height to half_height.
inline Points prism(size_t sides, float radius, float half_height) {
  Points points;
  for (size_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(sides);
    const auto x = static_cast<float>(radius * std::cos(angle));
    const auto y = static_cast<float>(radius * std::sin(angle));
    for (const float z : {-half_height, half_height}) points.emplace_back(x, y, z);
  }
  return points;
}

// Random points on an ellipsoid.
inline Points round_points(size_t count, const Eigen::Vector3f& half, oracle::Random& random) {
  Points points(count);
  for (Eigen::Vector3f& p : points) p = random.direction().cast<float>().cwiseProduct(half);
  return points;
}

inline Points scaled(Points points, float factor) {
  for (Eigen::Vector3f& p : points) p *= factor;
  return points;
}

}  // namespace carom::test
