// How far the corners of a shape reach along three axes.
#pragma once

#include <array>

#include "carom/shapes/hull.h"
#include "shapes/dop_polytope.h"
#include "shapes/turn.h"

namespace carom {

struct Interval {
  double lower, upper;
};

using Intervals = std::array<Interval, 3>;

// The least and the greatest of axis . point for each axis, in lanes of doubles. Zero is positive.
Intervals point_reach(const std::array<Double3, 3>& axes, const HullGeometry& hull);
Intervals point_reach(const std::array<Double3, 3>& axes, const DopPolytope& polytope);

}  // namespace carom
