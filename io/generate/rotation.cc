#include "io/generate/rotation.h"

#include <cmath>

namespace carom::io {

Quaternion product(const Quaternion& a, const Quaternion& b) {
  return {(a[3] * b[0] + a[0] * b[3]) + (a[1] * b[2] - a[2] * b[1]),
          (a[3] * b[1] + a[1] * b[3]) + (a[2] * b[0] - a[0] * b[2]),
          (a[3] * b[2] + a[2] * b[3]) + (a[0] * b[1] - a[1] * b[0]),
          (a[3] * b[3] - a[0] * b[0]) - (a[1] * b[1] + a[2] * b[2])};
}

Quaternion normalized(const Quaternion& q) {
  double norm = std::sqrt((q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3]));
  return {q[0] / norm, q[1] / norm, q[2] / norm, q[3] / norm};
}

Quaternion rotation_by(const Vec3& vector) {
  Vec3 half = {vector[0] / 2, vector[1] / 2, vector[2] / 2};
  double angle2 = (half[0] * half[0] + half[1] * half[1]) + half[2] * half[2];
  // Halves the angle until its Taylor series converges fast, and later doubles the rotation again.
  int doublings = 0;
  for (; angle2 > 0x1p-4; ++doublings) {
    for (double& x : half) x /= 2;
    angle2 /= 4;
  }
  double cosine = 1;
  double sine_ratio = 1;  // sin(angle) / angle
  for (int k = 10; k > 0; k -= 2) {
    cosine = 1 - angle2 / (k * (k - 1)) * cosine;
    sine_ratio = 1 - angle2 / (k * (k + 1)) * sine_ratio;
  }
  Quaternion q = {half[0] * sine_ratio, half[1] * sine_ratio, half[2] * sine_ratio, cosine};
  for (; doublings > 0; --doublings) q = normalized(product(q, q));
  return q;
}

Vec3 half_extents_turned(const Vec3& edges, const Quaternion& q) {
  auto [x, y, z, w] = q;
  double norm2 = (x * x + y * y) + (z * z + w * w);
  const Vec3 rows[3] = {
      {(x * x + w * w) - (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
      {2 * (x * y + z * w), (y * y + w * w) - (x * x + z * z), 2 * (y * z - x * w)},
      {2 * (x * z - y * w), 2 * (y * z + x * w), (z * z + w * w) - (x * x + y * y)}};
  Vec3 half;
  for (int i = 0; i < 3; ++i) {
    double reach = (std::fabs(rows[i][0]) * edges[0] + std::fabs(rows[i][1]) * edges[1]) +
                   std::fabs(rows[i][2]) * edges[2];
    half[i] = 0.5 * reach / norm2;
  }
  return half;
}

}  // namespace carom::io
