// A block of bodies spread out into columns.
#pragma once

#include <array>
#include <cstddef>

namespace carom {

// A multiple of every lane count, so that only the last block has a tail.
inline constexpr size_t kBodiesPerBlock = 1024;

struct BodyColumns {
  using Column = std::array<float, kBodiesPerBlock>;

  std::array<Column, 3> position;
  std::array<Column, 3> lower;  // relative to the position
  std::array<Column, 3> upper;
};

}  // namespace carom
