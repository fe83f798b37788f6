// Sums rounded outwards: the float32 nearest to the exact sum from below, or from above.
#pragma once

#include <cfloat>
#include <cmath>

namespace carom {

// a + b = sum + error, exactly (Knuth's TwoSum; TAOCP 2, 4.2.2). Error is NaN if the sum overflows.
template <class T>
struct TwoSum {
  T sum;
  T error;

  TwoSum(T a, T b) : sum(a + b) {
    const T b_part = sum - a;
    error = (a - (sum - b_part)) + (b - b_part);
  }
};

inline float next_down(float v) { return std::nextafter(v, -INFINITY); }
inline float next_up(float v) { return std::nextafter(v, INFINITY); }

// The largest float32 <= a + b. In float64, first the exact sum, then its rounding.
template <class T>
float sum_downwards(T a, T b) {
  const TwoSum<T> exact(a, b);
  const float rounded = static_cast<float>(exact.sum);
  const T back = static_cast<T>(rounded);
  const bool above = back > exact.sum || (back == exact.sum && exact.error < 0);
  return std::fmin(above ? next_down(rounded) : rounded, FLT_MAX);
}

// The smallest float32 >= a + b.
template <class T>
float sum_upwards(T a, T b) {
  const TwoSum<T> exact(a, b);
  const float rounded = static_cast<float>(exact.sum);
  const T back = static_cast<T>(rounded);
  const bool below = back < exact.sum || (back == exact.sum && exact.error > 0);
  return std::fmax(below ? next_up(rounded) : rounded, -FLT_MAX);
}

}  // namespace carom
