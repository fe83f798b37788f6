// A box that moves along a line, in the numbers that tests of nodes read.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "trees/tree.h"

namespace carom {

// The times at which the box meets others are t >= 0: the place at t is that at 0, plus t /
// inverse.
struct BoxPath {
  // A bound on the rounding of times: a difference, a reciprocal and two products, each by 2^-24,
  // or 2^-22 if the reciprocal is subnormal.
  static constexpr float kTimeRounding = 0x1p-20f;
  // A bound on what products lose by underflow.
  static constexpr float kTinyTime = 0x1p-100f;
  // A box that is displaced by less on an axis hardly moves there: the reciprocal would be near the
  // end of the range of float32, or beyond.
  static constexpr float kLeastDisplacement = 0x1p-120f;

  // On each axis: where the nearer and the further ends of boxes are in a node, and the ends of the
  // box that reach those first and last; reciprocals of the displacement, rounded so that times are
  // rounded outwards.
  std::array<uint8_t, 3> near_end, far_end;
  std::array<float, 3> from_near, from_far, inverse_near, inverse_far;

  // If the box hardly moves on this axis, [lower, upper] holds its whole path and the inverse is
  // infinite.
  void set(size_t axis, float lower, float upper, float inverse) {
    constexpr size_t kLower = offsetof(BoxTree::Node, lower) / sizeof(float);
    constexpr size_t kUpper = offsetof(BoxTree::Node, upper) / sizeof(float);
    const bool forwards = inverse >= 0;
    const size_t row = axis * BoxTree::kChildren;
    near_end[axis] = static_cast<uint8_t>((forwards ? kLower : kUpper) + row);
    far_end[axis] = static_cast<uint8_t>((forwards ? kUpper : kLower) + row);
    from_near[axis] = forwards ? upper : lower;
    from_far[axis] = forwards ? lower : upper;
    inverse_near[axis] = inverse * (1 - kTimeRounding);
    inverse_far[axis] = inverse * (1 + kTimeRounding);
  }
};

}  // namespace carom
