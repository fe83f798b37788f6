// The cross product of two vectors, right to its last digits even if they are nearly parallel.
//
// Source: T. J. Dekker, "A Floating-Point Technique for Extending the Available Precision",
// Numerische Mathematik 18, 1971, for the product with its rounding error.
#pragma once

#include "narrowphase/doubles/core.h"

namespace carom {

// Below this sine, squared, a triangle is a sliver: the rounding of its sides' products turns its
// normal by 2^-43 or more.
inline constexpr double kSliverSquared = 0x1p-20;

// a * b - c * d, off by about 2^-104 of a * b + c * d.
inline double difference_of_products(double a, double b, double c, double d) {
  const auto high_half = [](double x) {
    const double spread = 0x8000001p0 * x;
    return spread - (spread - x);
  };
  const auto rounding = [&](double x, double y, double product) {
    const double x_high = high_half(x), x_low = x - x_high;
    const double y_high = high_half(y), y_low = y - y_high;
    return ((x_high * y_high - product) + x_high * y_low + x_low * y_high) + x_low * y_low;
  };
  const double ab = a * b, cd = c * d;
  return (ab - cd) + (rounding(a, b, ab) - rounding(c, d, cd));
}

// Apart from its callers, which seldom need it.
[[gnu::noinline]] inline CoreVector sliver_cross(const CoreVector& u, const CoreVector& v) {
  return {difference_of_products(u.y, v.z, u.z, v.y), difference_of_products(u.z, v.x, u.x, v.z),
          difference_of_products(u.x, v.y, u.y, v.x)};
}

// Whether n = cross(u, v) is that of a sliver.
inline bool is_of_sliver(const CoreVector& n, const CoreVector& u, const CoreVector& v) {
  return !(dot(n, n) > kSliverSquared * (dot(u, u) * dot(v, v)));
}

}  // namespace carom
