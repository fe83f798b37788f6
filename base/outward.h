// Sums rounded outwards: the greatest float32 below the exact sum, or the smallest above it.
#pragma once

#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <limits>

namespace carom {

// a + b = sum + error, exactly (Knuth's TwoSum; TAOCP 2, 4.2.2). The error is NaN if the sum
// overflows.
template <class T>
struct TwoSum {
  T sum;
  T error;

  TwoSum(T a, T b) : sum(a + b) {
    const T b_part = sum - a;
    error = (a - (sum - b_part)) + (b - b_part);
  }
};

// std::nextafter towards -inf and +inf, without the call.
inline float next_down(float v) {
  if (!(v > -INFINITY)) return v;  // -inf or NaN
  if (v == 0) return -std::numeric_limits<float>::denorm_min();
  const auto bits = std::bit_cast<int32_t>(v);
  return std::bit_cast<float>(bits + (bits < 0 ? 1 : -1));
}
inline float next_up(float v) { return -next_down(-v); }

// next_down(v) if `is_above`, else v. Without a branch: how a sum rounds cannot be predicted.
inline float step_down_if(bool is_above, float v) {
  if (v == 0) return is_above ? next_down(0) : v;
  const auto bits = std::bit_cast<int32_t>(v);
  const int32_t step = is_above ? 1 : 0;
  return std::bit_cast<float>(bits + (bits < 0 ? step : -step));
}

// The largest float32 <= x. x must lie within the range of float32.
inline float round_downwards(double x) {
  const auto rounded = static_cast<float>(x);
  return step_down_if(rounded > x, rounded);
}

// The largest float32 <= a + b. For float64 it rounds the float64 sum, and its error decides ties.
template <class T>
float sum_downwards(T a, T b) {
  const TwoSum<T> exact(a, b);
  const float rounded = static_cast<float>(exact.sum);
  const T back = static_cast<T>(rounded);
  const bool is_above = (back > exact.sum) | ((back == exact.sum) & (exact.error < 0));
  const float sum = step_down_if(is_above, rounded);
  return sum < FLT_MAX ? sum : FLT_MAX;
}

// The smallest float32 >= a + b.
template <class T>
float sum_upwards(T a, T b) {
  const TwoSum<T> exact(a, b);
  const float rounded = static_cast<float>(exact.sum);
  const T back = static_cast<T>(rounded);
  const bool is_below = (back < exact.sum) | ((back == exact.sum) & (exact.error > 0));
  const float sum = -step_down_if(is_below, -rounded);
  return sum > -FLT_MAX ? sum : -FLT_MAX;
}

}  // namespace carom
