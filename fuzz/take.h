// Takes numbers from the front of the data; missing bytes are zero.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace carom::fuzz {

using Data = std::span<const uint8_t>;

template <class T>
T take(Data& data) {
  T value{};
  const size_t size = std::min(data.size(), sizeof value);
  std::memcpy(&value, data.data(), size);
  data = data.subspan(size);
  return value;
}

// A multiple of 2^-15 in [-1, 1), so that 0, 1/2, 1/4 and so on occur exactly.
inline double take_unit(Data& data) { return take<int16_t>(data) * 0x1p-15; }

inline Eigen::Vector3d take_vector(Data& data) {
  const double x = take_unit(data), y = take_unit(data);
  return {x, y, take_unit(data)};
}

// Zero bytes give the identity. The quaternion is seldom a unit one and hardly ever zero.
inline Eigen::Quaternionf take_orientation(Data& data) {
  const auto bytes = take<std::array<int8_t, 4>>(data);
  Eigen::Quaternionf q;
  q.coeffs() << bytes[0], bytes[1], bytes[2], static_cast<int8_t>(bytes[3] ^ 0x7f);
  return q;
}

}  // namespace carom::fuzz
