// Random numbers that are the same with every compiler and on every machine. This folder uses only
// integer arithmetic and + - * / sqrt of doubles. It avoids the distributions of the standard
// library and the maths library, whose last bits differ between systems.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace carom::io {

using Vec3 = std::array<double, 3>;
using Quaternion = std::array<double, 4>;  // x, y, z, w

// SplitMix64 (Steele, Lea and Flood 2014).
inline uint64_t mix64(uint64_t value) {
  value = (value ^ value >> 30) * 0xbf58476d1ce4e5b9u;
  value = (value ^ value >> 27) * 0x94d049bb133111ebu;
  return value ^ value >> 31;
}

class Random {
 public:
  // Streams of one seed are independent of each other.
  Random(uint64_t seed, uint64_t stream) : state_(mix64(seed + kStep) ^ mix64(stream * kStep)) {}

  uint64_t bits() { return mix64(state_ += kStep); }
  // Multiples of 2^-53 in [0, 1).
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  double between(double lower, double upper) { return lower + (upper - lower) * unit(); }
  // In [0, bound).
  uint64_t below(uint32_t bound) { return (bits() >> 32) * bound >> 32; }

  // Uniform in the ball of that radius.
  Vec3 in_ball(double radius);
  // Uniform direction, length between `inner` and `outer`.
  Vec3 in_shell(double inner, double outer);
  // Uniform in the disc of that radius in the plane y = 0.
  Vec3 in_disc(double radius);
  // Uniform among all rotations; not a unit quaternion.
  Quaternion rotation();

 private:
  static constexpr uint64_t kStep = 0x9e3779b97f4a7c15u;
  uint64_t state_;
};

// Draws numbers whose logarithm is uniform.
class LogUniform {
 public:
  LogUniform(double lower, double upper);
  double draw(Random& random) const;

 private:
  static constexpr int kBits = 32;
  double lower_;
  // (upper / lower)^(1/2), ^(1/4), ...: the factor for each random bit of the exponent.
  std::array<double, kBits> roots_{};
};

double cube_root(double value);

// Half the extents, along the world axes, of a box with these edges turned about y at random.
Vec3 half_extents_turned_about_y(const Vec3& edges, Random& random);

}  // namespace carom::io
