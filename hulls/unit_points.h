// Scales points of any size to size one.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace carom::hulls {

struct UnitPoints {
  // Distinct points, centred at the origin. Each axis is scaled by a power of two so that the
  // extent along it is 1/2 to 1, or 0.
  std::vector<Eigen::Vector3d> point;
  std::vector<uint32_t> source;  // the first index of each among the given points; ascending
  Eigen::Vector3d rounding;      // half a step of a float at the largest coordinate of each axis
  Eigen::Vector3d lower, half;   // the least coordinates; half of the extents, scaled
  std::array<int, 3> exponent;   // of the powers of two

  // Where a scaled point was.
  Eigen::Vector3d unscaled(const Eigen::Vector3d& p) const;
};

// The points must be finite; there is at least one, and at most 2^32 - 1.
UnitPoints unit_points(std::span<const Eigen::Vector3f> points);

}  // namespace carom::hulls
