// Decides spheres within float32 rounding of touching a second time, in double precision, from the
// positions as they are given.
//
// Source of the form: sqrt(x) - r = (x - r^2) / (sqrt(x) + r), which does not cancel (N. J. Higham,
// Accuracy and Stability of Numerical Algorithms, 2nd ed., 2002, section 1.8).
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "base/tolerances.h"
#include "narrowphase/scalar/length.h"

namespace carom::scalar {

using Eigen::Vector3d;

// Whether rounding could have decided. `size`: the size of the numbers that were rounded.
inline bool is_near_touch(float separation, float size) {
  return std::fabs(separation) <= size * kNearTouch;
}

inline double squared_length(const Vector3d& v) {
  return (v.x() * v.x() + v.y() * v.y()) + v.z() * v.z();
}

// The gap between a ball of radius `reach` and a point at the given squared distance; 0 only if
// they touch exactly in double.
inline float gap_to_ball(double squared_distance, double reach) {
  const double limit = kLargest;
  if (squared_distance > 4 * limit * limit) return kLargest;
  const double difference = squared_distance - reach * reach;
  if (difference == 0) return 0;
  double gap = difference / (std::sqrt(squared_distance) + reach);
  if (gap > limit) gap = limit;
  if (gap < -limit) gap = -limit;
  // A gap that vanishes in float32 must stay a gap.
  const float smallest = std::numeric_limits<float>::denorm_min();
  const float rounded = static_cast<float>(gap);
  return difference > 0 && rounded < smallest ? smallest : rounded;
}

}  // namespace carom::scalar
