// Box along the world axes (A) against another (B): the gap along each axis.
//
// Source: C. Ericson, Real-Time Collision Detection, 2005, section 4.2.1 (overlap of intervals in
// every axis). The signed gap per axis also gives the rest: the distance of separate boxes is the
// length of the vector of positive gaps; overlapping ones separate along the axis of least overlap.
#pragma once

#include "narrowphase/scalar/length.h"
#include "narrowphase/scalar/separation.h"

namespace carom::scalar {

// The gap of two boxes along one axis, each box relative to its position; B is at `d` from A.
struct AxisGap {
  float gap;      // of the two intervals; negative: they overlap by that much
  bool is_right;  // B lies, or separates, towards greater coordinates
};

// (B, A) gives the same gap and the other side, because either way `d` is added to the same
// difference.
inline AxisGap axis_gap(float lower_a, float upper_a, float lower_b, float upper_b, float d) {
  const float right = (lower_b - upper_a) + d;
  const float left = (lower_a - upper_b) - d;
  const bool is_right = right >= left;
  return {is_right ? right : left, is_right};
}

// Corners are relative to the position of their body; `d` is the position of B relative to that of
// A.
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

  // The axis of the least overlap; ties go to the first axis.
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
      // The middle of the intersection of the intervals; halved first, since the sum could
      // overflow.
      result.arm_a[i] =
          0.5f * max(lower_a[i], moved_lower_b[i]) + 0.5f * min(upper_a[i], moved_upper_b[i]);
      result.arm_b[i] = result.arm_a[i] - d[i];
    }
  }
  return result;
}

}  // namespace carom::scalar
