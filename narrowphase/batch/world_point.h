// Witness points of single bodies in world coordinates, computed as the kernels do: a float64
// position is split into a float32 and the remainder. A NaN (no answer) keeps its bits.
#pragma once

#include <array>

#include "shapes/body_reader.h"

namespace carom {

inline float world_coordinate(float position, float arm) {
  return arm != arm ? arm : position + arm;
}
inline float world_coordinate(double position, float arm) {
  if (arm != arm) return arm;
  const auto high = static_cast<float>(position);
  return high + (static_cast<float>(position - high) + arm);
}

template <class T>
std::array<float, 3> world_point(const Position<T>& position, const std::array<float, 3>& arm) {
  return {world_coordinate(position.x, arm[0]), world_coordinate(position.y, arm[1]),
          world_coordinate(position.z, arm[2])};
}

inline std::array<float, 3> world_point(const BodyReader& reader, size_t body,
                                        const std::array<float, 3>& arm) {
  return reader.is_float64() ? world_point(reader.position<double>(body), arm)
                             : world_point(reader.position<float>(body), arm);
}

}  // namespace carom
