// Runs the test of one pair in scaled units, in float or in double.
#pragma once

#include <limits>

#include "base/powers.h"
#include "narrowphase/scalar/separation.h"
#include "narrowphase/scalar/shapes.h"

namespace carom::scalar {

struct DoubleScale {
  double up;
  double down;
};

// Zero, infinity and NaN have the scale of 0.5.
inline DoubleScale scale_of(double magnitude) {
  const bool has_exponent = magnitude > 0 && magnitude <= std::numeric_limits<double>::max();
  const int exponent = has_exponent ? exponent_of(magnitude) : -1;
  const int within = std::min(std::max(exponent, -1000), 1000);
  return {power_of_two(within), power_of_two(-within)};
}

template <class Real>
using ScaleOf = decltype(scale_of(Real()));

// The scale of the units in which the greatest coordinate of a pair lies between one and two.
template <class Real, class A, class B>
ScaleOf<Real> scale_of_pair(const A& a, const B& b, const PairPose<Real>& pose) {
  return scale_of(max(largest_component(pose.d), max(a.size(), b.size())));
}

template <class Real>
PairPose<Real> scaled_pose(const PairPose<Real>& pose, const ScaleOf<Real>& scale) {
  return {pose.d * scale.down, pose.a, pose.b};
}

// In place: a copy made compilers write numbers in one size and read them in another, and wait.
template <class Real>
void put_in_metres(SeparationAs<Real>& s, const ScaleOf<Real>& scale) {
  s.separation = finite(s.separation * scale.up);
  s.arm_a *= scale.up;
  s.arm_b *= scale.up;
}

// Returns separate(a, b, pose), run in units in which the greatest coordinate lies between one and
// two; the result is in metres again.
template <class Real, class A, class B, class Separate>
SeparationAs<Real> in_scaled_units(const A& a, const B& b, const PairPose<Real>& pose,
                                   const Separate& separate) {
  const ScaleOf<Real> scale = scale_of_pair(a, b, pose);
  SeparationAs<Real> result =
      separate(a.scaled(scale.down), b.scaled(scale.down), scaled_pose(pose, scale));
  put_in_metres(result, scale);
  return result;
}

// Rounds to the nearest float, except that a gap stays above zero and a finite number finite.
inline float round_separation(double separation) {
  constexpr float kSmallest = std::numeric_limits<float>::denorm_min();
  if (separation > kLargest)
    return std::isinf(separation) ? static_cast<float>(separation) : kLargest;
  if (separation < -double{kLargest}) return -kLargest;
  const auto rounded = static_cast<float>(separation);
  return separation > 0 && rounded < kSmallest ? kSmallest : rounded;
}

inline Separation rounded(const SeparationAs<double>& s) {
  return {round_separation(s.separation), s.normal.cast<float>(), s.arm_a.cast<float>(),
          s.arm_b.cast<float>(), s.status};
}

}  // namespace carom::scalar
