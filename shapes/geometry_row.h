// Geometries as rows of shape parameters: their address.
#pragma once

#include <array>
#include <cstring>

namespace carom {

// nullptr: a row of zeros.
inline std::array<float, 4> geometry_row(const void* geometry) {
  std::array<float, 4> row{};
  static_assert(sizeof geometry <= sizeof row);
  std::memcpy(row.data(), &geometry, sizeof geometry);
  return row;
}

// From where such a row begins.
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
