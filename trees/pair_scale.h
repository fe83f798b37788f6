// The unit in which two trees are searched together in float32.
#pragma once

#include <algorithm>

#include "base/powers.h"
#include "base/tolerances.h"
#include "shapes/turn.h"

namespace carom {

// In this unit, a power of two, all lengths of two trees and of the offset between their frames are
// at most 1. (Beyond the range of float32 they may be 100, and below it they are less.)
struct PairScale {
  double down, up;  // units in a metre, metres in a unit
  double slack;     // in units
  double grow;      // in units: the reach and the slack

  // `size_a`, `size_b`: the greatest coordinate of each tree. `reach` may be infinite.
  PairScale(double size_a, double size_b, const Double3& offset, double reach) {
    const double lengths = size_a + size_b + std::min(greatest(offset), kFarthest);
    const int exponent = lengths > 0 ? exponent_of(lengths) + 1 : 0;
    const int clamped = std::clamp(exponent, -kMostExponent, kMostExponent);
    down = power_of_two(-clamped);
    up = power_of_two(clamped);
    slack = kTreeSlack * lengths * down;
    grow = grow_of(reach);
  }

  double grow_of(double reach) const { return std::min(reach * down + slack, kEverything); }

  // In units. An offset beyond all lengths is cut, which brings nothing further apart.
  float offset(double x) const {
    return static_cast<float>(std::clamp(x, -kFarthest, kFarthest) * down);
  }

 private:
  static constexpr int kMostExponent = 125;
  static constexpr double kFarthest = 0x1p132;
  static constexpr double kEverything = 0x1p100;
};

}  // namespace carom
