// Sums rounded outwards to float32.
//
// Source of the exact sum: D. E. Knuth, The Art of Computer Programming, volume 2, section 4.2.2,
// theorem B (TwoSum): the rounding error of a sum of two floats is itself a float, and six
// operations yield it.
#pragma once

#include <cmath>
#include <limits>

namespace carom::reference {

template <class Real>
struct ExactSum {
  Real sum;    // rounded
  Real error;  // sum + error = a + b without rounding
};

template <class Real>
ExactSum<Real> two_sum(Real a, Real b) {
  const Real sum = a + b;
  const Real rounded_b = sum - a;
  const Real rounded_a = sum - rounded_b;
  return {sum, (a - rounded_a) + (b - rounded_b)};
}

inline float step_down(float x) {
  return std::nextafter(x, -std::numeric_limits<float>::infinity());
}
inline float step_up(float x) { return std::nextafter(x, std::numeric_limits<float>::infinity()); }

// The largest float that is not above the exact sum. (The error is at most half a unit. So if the
// rounded sum is too large, the next float below it is the answer.)
inline float round_down(const ExactSum<float>& s) { return s.error < 0 ? step_down(s.sum) : s.sum; }

inline float round_down(const ExactSum<double>& s) {
  const auto rounded = static_cast<float>(s.sum);
  const bool is_above = rounded > s.sum || (rounded == s.sum && s.error < 0);
  return is_above ? step_down(rounded) : rounded;
}

// The smallest float that is not below the exact sum.
inline float round_up(const ExactSum<float>& s) { return s.error > 0 ? step_up(s.sum) : s.sum; }

inline float round_up(const ExactSum<double>& s) {
  const auto rounded = static_cast<float>(s.sum);
  const bool is_below = rounded < s.sum || (rounded == s.sum && s.error > 0);
  return is_below ? step_up(rounded) : rounded;
}

// a + b rounded as a lower corner, or as an upper one. A sum beyond the range of float32 rounds to
// infinity, which is no bound on that side; the largest float is.
template <class Real>
float sum_down(Real a, Real b) {
  return std::fmin(round_down(two_sum(a, b)), std::numeric_limits<float>::max());
}
template <class Real>
float sum_up(Real a, Real b) {
  return std::fmax(round_up(two_sum(a, b)), -std::numeric_limits<float>::max());
}

}  // namespace carom::reference
