// Measures of a triangle, for those who make meshes.
#pragma once

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>

#include "base/outward.h"
#include "base/tolerances.h"
#include "geometries/part.h"
#include "trees/tree.h"

namespace carom {

inline bool has_area(const std::array<Double3, 3>& corners) {
  const auto& [a, b, c] = corners;
  const auto length = [](const Double3& v) { return std::sqrt(dot(v, v)); };
  const double area = length(cross(minus(b, a), minus(c, a)));
  return area > kWithoutArea * (length(minus(b, a)) * length(minus(c, a)));
}

// A box around a triangle that is so thick behind its front, rounded outwards.
inline TreeBox box_of_triangle(const std::array<Double3, 3>& corners, double thickness) {
  const auto downwards = [](double x) {
    return round_downwards(std::clamp(x, -double{FLT_MAX}, double{FLT_MAX}));
  };
  const Double3 back = way_back(corners[0], corners[1], corners[2], thickness);
  const double slack = thickness * (greatest(back) > 0 ? 0x1p-24 : 1);
  TreeBox box;
  for (size_t axis = 0; axis < 3; ++axis) {
    const auto [lower, upper] = std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
    box.lower[axis] = downwards(lower + std::min(back[axis], 0.0) - slack);
    box.upper[axis] = -downwards(-(upper + std::max(back[axis], 0.0) + slack));
  }
  return box;
}

}  // namespace carom
