// Runs the test of one pair in scaled units, in float or in double.
#pragma once

#include <limits>

#include "narrowphase/scalar/separation.h"
#include "narrowphase/scalar/shapes.h"

namespace carom::scalar {

struct DoubleScale {
  double up;
  double down;
};

inline DoubleScale scale_of(double magnitude) {
  int exponent = 0;
  (void)std::frexp(magnitude, &exponent);
  exponent = std::min(std::max(exponent - 1, -1000), 1000);
  return {std::ldexp(1.0, exponent), std::ldexp(1.0, -exponent)};
}

// Returns separate(a, b, pose), run in units in which the greatest coordinate lies between one and
// two; the result is in metres again.
template <class Real, class A, class B, class Separate>
SeparationAs<Real> in_scaled_units(const A& a, const B& b, const PairPose<Real>& pose,
                                   const Separate& separate) {
  const auto scale = scale_of(max(largest_component(pose.d), max(a.size(), b.size())));
  const PairPose<Real> scaled_pose{pose.d * scale.down, pose.a, pose.b};
  SeparationAs<Real> result = separate(a.scaled(scale.down), b.scaled(scale.down), scaled_pose);
  result.separation = finite(result.separation * scale.up);
  result.arm_a *= scale.up;
  result.arm_b *= scale.up;
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
