// Vector helpers, and rotations of shapes by the orientation of their body, in double precision.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "shapes/body_reader.h"

namespace carom {

using Double3 = std::array<double, 3>;

// A generous bound on the rounding of a rotation and the sums that follow, as a share of the
// greatest length that goes in.
inline constexpr double kTurnRounding = 0x1p-46;

inline double dot(const Double3& a, const Double3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Double3 minus(const Double3& a, const Double3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline double greatest(const Double3& v) {
  return std::max(std::max(std::fabs(v[0]), std::fabs(v[1])), std::fabs(v[2]));
}

inline Double3 vector_of(const Row& row) { return {row[0], row[1], row[2]}; }

// The rows of M(q) / |q|^2.
inline std::array<Double3, 3> rotation_of(const Row& q) {
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  const double s = 2 / ((x * x + y * y) + (z * z + w * w));
  return {{{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
           {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)},
           {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}}};
}

// The vector from the front of a thick triangle to its back. Zero if the triangle has hardly any
// area, so that its normal is unreliable.
inline Double3 way_back(const Double3& a, const Double3& b, const Double3& c, double thickness) {
  const Double3 u = minus(b, a);
  const Double3 v = minus(c, a);
  const Double3 n = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                     u[0] * v[1] - u[1] * v[0]};
  const double length = std::sqrt(dot(n, n));
  if (!(length > 0x1p-24 * greatest(u) * greatest(v))) return {};
  return {-n[0] / length * thickness, -n[1] / length * thickness, -n[2] / length * thickness};
}

// The greatest absolute number of the rows. The fourth number of the first row is a radius or a
// thickness.
inline double greatest_of(std::span<const Row> rows) {
  double size = rows[0][3];
  for (const Row& row : rows) size = std::max(size, greatest(vector_of(row)));
  return size;
}

}  // namespace carom
