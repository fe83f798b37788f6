// The points of a convex body in the frame of a mesh, as lanes read them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "base/powers.h"
#include "carom/shapes/hull.h"
#include "geometries/part.h"
#include "trees/tree.h"

namespace carom {

// The points are relative to one between them, so that float32 rounds them little. Their unit is a
// power of two.
struct SeenPoints {
  static constexpr size_t kMost = 64;

  double down, up;              // units in a metre, metres in a unit
  std::array<float, 3> middle;  // metres
  float size;                   // the greatest coordinate, in units
  size_t count;
  alignas(64) std::array<std::array<float, kMost>, 3> column;  // in units

  // Takes a unit of about `length` metres.
  void set_unit(double length) {
    constexpr int kMostExponent = 120;
    const int exponent = length > 0 ? exponent_of(length) + 1 : 0;
    const int clamped = std::clamp(exponent, -kMostExponent, kMostExponent);
    down = power_of_two(-clamped);
    up = power_of_two(clamped);
  }

  // `points`: metres, at least one and at most kMost. All of the body lies within about `extent`
  // of `its_middle`.
  template <class Points>
  void set(const Points& points, const Double3& its_middle, double extent) {
    set_unit(extent);
    count = points.size();
    double furthest = 0;
    for (size_t axis = 0; axis < 3; ++axis) {
      middle[axis] = static_cast<float>(its_middle[axis]);
      for (size_t i = 0; i < count; ++i) {
        const double x = (points[i][axis] - middle[axis]) * down;
        furthest = std::max(furthest, std::fabs(x));
        column[axis][i] = static_cast<float>(x);
      }
    }
    size = static_cast<float>(furthest);
  }
};

// Turns and moves the points of a hull, which has at most SeenPoints::kMost, and returns the box
// around them; both up to the rounding of float32 to the size of the hull. Where a coordinate of
// the middle is beyond float32 only the box has a meaning. The same on every ISA.
PartBox see_hull(const HullGeometry& hull, const FrameChange& change, SeenPoints& seen);

}  // namespace carom
