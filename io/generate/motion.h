// Moves generated bodies from one frame to the next and stores them in the frame's arrays.
#pragma once

#include <cmath>
#include <cstddef>
#include <tuple>
#include <vector>

#include "io/generate/random.h"
#include "io/generate/rotation.h"

namespace carom::io {

// Mirrors a coordinate that has passed a wall.
inline void bounce(double lower, double upper, double& x, double& velocity) {
  if (x >= lower && x <= upper) return;
  double wall = x < lower ? lower : upper;
  velocity = x < lower ? std::fabs(velocity) : -std::fabs(velocity);
  x = std::fmin(std::fmax(wall + (wall - x), lower), upper);
}

inline Quaternion turned(const Quaternion& orientation, const Vec3& velocity, double dt) {
  const Vec3 angle = {velocity[0] * dt, velocity[1] * dt, velocity[2] * dt};
  return normalized(product(rotation_by(angle), orientation));
}

template <class Row, class T>
void store_rows(bool wanted, const std::vector<Row>& rows, std::vector<T>& out) {
  out.resize(wanted ? rows.size() * std::tuple_size_v<Row> : 0);
  if (!wanted) return;
  T* next = out.data();
  for (const Row& row : rows) {
    for (double value : row) *next++ = static_cast<T>(value);
  }
}

}  // namespace carom::io
