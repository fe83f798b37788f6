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

template <class Geometry>
const Geometry* geometry_at(const std::array<float, 4>& row) {
  const void* geometry;
  std::memcpy(&geometry, row.data(), sizeof geometry);
  return static_cast<const Geometry*>(geometry);
}

}  // namespace carom
