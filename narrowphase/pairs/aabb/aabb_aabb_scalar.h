// Box along the world axes (A) against another (B): the gap along each axis.
//
// Source: C. Ericson, Real-Time Collision Detection, 2005, section 4.2.1 (overlap of intervals in
// every axis). The signed gap per axis also gives the rest: the distance of separate boxes is the
// length of the vector of positive gaps; overlapping ones separate along the axis of least overlap.
#pragma once

#include "narrowphase/scalar/length.h"
#include "narrowphase/scalar/separation.h"

namespace carom::scalar {

// One axis of two boxes, each relative to its position; B's is at `d` from A's.
struct AxisGap {
  float gap;      // of the two intervals; negative: they overlap by that much
  bool is_right;  // B goes to the right to separate (or lies there), otherwise to the left
};

// The same for (B, A) but for the side: either way `d` is added to the same difference.
inline AxisGap axis_gap(float lower_a, float upper_a, float lower_b, float upper_b, float d) {
  const float right = (lower_b - upper_a) + d;
  const float left = (lower_a - upper_b) - d;
  const bool is_right = right >= left;
  return {is_right ? right : left, is_right};
}

// Corners are relative to the position of their body, and `d` is the position of B relative to A's.
inline Separation aabb_aabb(const Vector3f& lower_a, const Vector3f& upper_a,
                            const Vector3f& lower_b, const Vector3f& upper_b, const Vector3f& d) {
  const Vector3f moved_lower_b = lower_b + d;
  const Vector3f moved_upper_b = upper_b + d;
  AxisGap axes[3];
  Vector3f delta;
  for (int i = 0; i < 3; ++i) {
    axes[i] = axis_gap(lower_a[i], upper_a[i], lower_b[i], upper_b[i], d[i]);
    delta[i] = min(max(axes[i].gap, 0.0f), kLargest);
  }
  const Length distance = length_of(delta);
  const bool is_separate = !distance.is_zero;
  const auto sign = [&](int i, float x) { return axes[i].is_right ? x : -x; };

  // Of equal overlaps the first axis.
  const int axis = axes[0].gap >= axes[1].gap && axes[0].gap >= axes[2].gap ? 0
                   : axes[1].gap >= axes[2].gap                             ? 1
                                                                            : 2;
  Separation result;
  result.separation = is_separate ? distance.length : axes[axis].gap;
  for (int i = 0; i < 3; ++i) {
    if (is_separate) {
      result.normal[i] = sign(i, distance.direction[i]);
    } else {
      result.normal[i] = i == axis ? sign(i, 1.0f) : 0.0f;
    }
    const bool faces_meet = axes[i].gap > 0 || (!is_separate && i == axis);
    if (faces_meet) {
      result.arm_a[i] = axes[i].is_right ? upper_a[i] : lower_a[i];
      result.arm_b[i] = axes[i].is_right ? lower_b[i] : upper_b[i];
    } else {
      // The middle of what the intervals share; halved first, as the sum could overflow.
      result.arm_a[i] =
          0.5f * max(lower_a[i], moved_lower_b[i]) + 0.5f * min(upper_a[i], moved_upper_b[i]);
      result.arm_b[i] = result.arm_a[i] - d[i];
    }
  }
  return result;
}

}  // namespace carom::scalar
