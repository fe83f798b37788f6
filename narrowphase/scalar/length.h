// Three-vectors of the scalar tests: one written order of summation, and lengths that neither
// overflow nor underflow.
//
// Source of the scaling: J. L. Blue, "A Portable Fortran Program to Find the Euclidean Norm of a
// Vector", ACM TOMS 4(1), 1978; here with a power of two, so that scaling itself is exact.
#pragma once

#include <Eigen/Core>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace carom::scalar {

using Eigen::Vector3f;

inline constexpr float kLargest = std::numeric_limits<float>::max();

// The second operand if the two are equal, as in lanes: +0 and -0 are equal, but their bits are
// not.
inline float max(float a, float b) { return a > b ? a : b; }
inline float min(float a, float b) { return a < b ? a : b; }

// Infinities, from sums beyond the range of float, become the largest float of their sign.
inline float clamp_to_finite(float x) { return min(max(x, -kLargest), kLargest); }

// Three terms are added in this order everywhere; a library's own order may change with its
// version.
inline float dot(const Vector3f& a, const Vector3f& b) {
  return (a.x() * b.x() + a.y() * b.y()) + a.z() * b.z();
}

// b - a, from one subtraction in the type of the positions: close bodies far from the origin lose
// no digits (Sterbenz: the difference of numbers within a factor of two is exact).
template <class Vector>
Vector3f relative_position(const Vector& a, const Vector& b) {
  const Vector3f difference = (b - a).template cast<float>();
  return difference.unaryExpr(&clamp_to_finite);
}

inline float largest_component(const Vector3f& v) {
  return max(max(std::fabs(v.x()), std::fabs(v.y())), std::fabs(v.z()));
}

// up = 2^k and down = 2^-k, where 2^k is the power of two in `magnitude`, clamped so that both are
// normal floats.
struct Scale {
  float up;
  float down;
};

inline Scale scale_of(float magnitude) {
  constexpr uint32_t kExponent = 0x7f800000;  // the exponent field alone is a power of two
  constexpr uint32_t kLowest = 0x00800000;    // 2^-126
  constexpr uint32_t kHighest = 0x7e800000;   // 2^126
  constexpr uint32_t kProduct = 0x7f000000;   // exponent fields that add up to this: up * down = 1
  uint32_t bits = std::bit_cast<uint32_t>(magnitude) & kExponent;
  bits = bits < kLowest ? kLowest : bits > kHighest ? kHighest : bits;
  return {std::bit_cast<float>(bits), std::bit_cast<float>(kProduct - bits)};
}

struct Length {
  float length;
  Vector3f direction;  // unit; meaningless if the vector is zero
  bool is_zero;        // exactly, however short the vector is
};

inline Length length_of(const Vector3f& v) {
  const Scale scale = scale_of(largest_component(v));
  const Vector3f scaled = v * scale.down;  // components below 4: squares are harmless
  const float length = std::sqrt(dot(scaled, scaled));
  return {min(length * scale.up, kLargest), scaled * (1.0f / length), length == 0};
}

}  // namespace carom::scalar
