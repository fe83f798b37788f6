// Random numbers that are the same with every standard library.
#pragma once

#include <Eigen/Core>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace carom::oracle {

class Random {
 public:
  explicit Random(uint64_t seed) : engine_(seed) {}

  uint64_t bits() { return engine_(); }
  uint64_t below(uint64_t count) { return bits() % count; }
  bool chance(double probability) { return uniform(0, 1) < probability; }

  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53);
  }
  double log_uniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }

  Eigen::Vector3d direction() {
    const double z = uniform(-1, 1);
    const double angle = uniform(0, 2 * std::numbers::pi);
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }

  // Any float at all: infinities, NaN and subnormals included.
  float any_float() { return std::bit_cast<float>(static_cast<uint32_t>(bits())); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace carom::oracle
