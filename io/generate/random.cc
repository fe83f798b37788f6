#include "io/generate/random.h"

#include <cmath>

namespace carom::io {

Vec3 Random::in_ball(double radius) {
  for (;;) {
    double x = between(-1, 1);
    double y = between(-1, 1);
    double z = between(-1, 1);
    if ((x * x + y * y) + z * z <= 1) return {x * radius, y * radius, z * radius};
  }
}

Vec3 Random::in_shell(double inner, double outer) {
  for (;;) {
    const Vec3 v = in_ball(1);
    const double norm = std::sqrt((v[0] * v[0] + v[1] * v[1]) + v[2] * v[2]);
    if (!(norm > 0x1p-5)) continue;
    const double scale = between(inner, outer) / norm;
    return {v[0] * scale, v[1] * scale, v[2] * scale};
  }
}

Vec3 Random::in_disc(double radius) {
  for (;;) {
    double x = between(-1, 1);
    double z = between(-1, 1);
    if (x * x + z * z <= 1) return {x * radius, 0, z * radius};
  }
}

Quaternion Random::rotation() {
  // A uniform direction in four dimensions is a uniform rotation.
  for (;;) {
    double x = between(-1, 1);
    double y = between(-1, 1);
    double z = between(-1, 1);
    double w = between(-1, 1);
    double norm2 = (x * x + y * y) + (z * z + w * w);
    if (norm2 <= 1 && norm2 >= 0x1p-20) return {x, y, z, w};
  }
}

LogUniform::LogUniform(double lower, double upper) : lower_(lower) {
  double root = upper / lower;
  for (double& entry : roots_) entry = root = std::sqrt(root);
}

double LogUniform::draw(Random& random) const {
  uint64_t exponent = random.bits();
  double value = lower_;
  for (int i = 0; i < kBits; ++i) {
    if (exponent >> i & 1) value *= roots_[i];
  }
  return value;
}

double cube_root(double value) {
  if (!(value > 0)) return 0;
  // Newton's method from above: the root decreases until rounding stops it.
  double root = value > 1 ? value : 1;
  for (;;) {
    double next = root - (root - value / (root * root)) / 3;
    if (!(next < root)) return root;
    root = next;
  }
}

Vec3 half_extents_turned_about_y(const Vec3& edges, Random& random) {
  double c, s, norm2;
  do {
    c = random.between(-1, 1);
    s = random.between(-1, 1);
    norm2 = c * c + s * s;
  } while (norm2 > 1 || norm2 < 0x1p-20);
  double norm = std::sqrt(norm2);
  c = std::fabs(c) / norm;
  s = std::fabs(s) / norm;
  return {0.5 * (c * edges[0] + s * edges[2]), 0.5 * edges[1], 0.5 * (s * edges[0] + c * edges[2])};
}

}  // namespace carom::io
