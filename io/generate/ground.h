// Rolling ground: smooth noise between random heights on a square lattice.
#pragma once

#include <cmath>
#include <cstdint>

#include "io/generate/random.h"

namespace carom::io {

class Ground {
 public:
  explicit Ground(uint64_t seed) : seed_(seed) {}

  double height(double x, double z) const {
    double column = std::floor(x / kCell);
    double row = std::floor(z / kCell);
    double s = smooth(x / kCell - column);
    double t = smooth(z / kCell - row);
    double near = blend(lattice(column, row), lattice(column + 1, row), s);
    double far = blend(lattice(column, row + 1), lattice(column + 1, row + 1), s);
    return blend(near, far, t);
  }

 private:
  static constexpr double kCell = 40;      // metres
  static constexpr double kAmplitude = 5;  // metres

  static double smooth(double t) { return t * t * (3 - 2 * t); }
  static double blend(double a, double b, double t) { return a + (b - a) * t; }

  double lattice(double column, double row) const {
    auto x = static_cast<uint64_t>(static_cast<int64_t>(column));
    auto z = static_cast<uint64_t>(static_cast<int64_t>(row));
    Random random(seed_ + mix64(x), z);
    return random.between(-kAmplitude, kAmplitude);
  }

  uint64_t seed_;
};

}  // namespace carom::io
