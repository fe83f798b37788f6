// Stores the address of a geometry in a row of shape parameters, and reads it back. The fourth
// number of the row is free: it is the rounding of a hull.
#pragma once

#include <array>
#include <cstring>

namespace carom {

// A nullptr gives a row of zeros.
inline std::array<float, 4> geometry_row(const void* geometry) {
  std::array<float, 4> row{};
  static_assert(sizeof geometry <= 3 * sizeof(float));
  std::memcpy(row.data(), &geometry, sizeof geometry);
  return row;
}

// `row`: the first number of such a row.
template <class Geometry>
const Geometry* geometry_at(const float* row) {
  const void* geometry;
  std::memcpy(&geometry, row, sizeof geometry);
  return static_cast<const Geometry*>(geometry);
}

template <class Geometry>
const Geometry* geometry_at(const std::array<float, 4>& row) {
  return geometry_at<Geometry>(row.data());
}

}  // namespace carom
