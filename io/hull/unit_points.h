// Points of any size as points of size one.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace carom::io {

struct UnitPoints {
  // About the origin, every axis scaled by a power of two so that the extents along it are 1/2 to
  // 1, or 0. Every point once.
  std::vector<Eigen::Vector3d> point;
  std::vector<uint32_t> source;  // the first index of each in what was given; ascending
  Eigen::Vector3d rounding;      // half a step of a float at the largest coordinate of each axis
};

// The points must be finite; there is at least one, and at most 2^32 - 1.
UnitPoints unit_points(std::span<const Eigen::Vector3f> points);

}  // namespace carom::io
