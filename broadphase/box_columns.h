// Boxes in the order of a search: six columns and whose boxes they are.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "carom/kernel/views.h"
#include "kernel/parallel.h"

namespace carom {

// Axis 0 is the one that is swept. Behind the last row lie kPadding rows of NaN, which overlap
// nothing, so that whole vectors can be read.
struct BoxColumns {
  static constexpr size_t kPadding = 16;

  std::array<std::vector<float>, 3> lower;
  std::array<std::vector<float>, 3> upper;
  std::vector<uint32_t> body;
  size_t count = 0;

  // Rows body[i] of `bounds`, axes in the order first_axis, first_axis + 1, ...
  void fill(const BoundsView& bounds, size_t first_axis, Parallelism parallelism);

  size_t bytes() const;
};

// Entry i of one of the six columns.
inline float value_at(const BoundsView& bounds, const float* column, size_t i) {
  return *reinterpret_cast<const float*>(reinterpret_cast<const char*>(column) + i * bounds.stride);
}

// lower <= upper on every axis; false for empty boxes and NaN.
inline bool takes_part(const BoundsView& bounds, size_t i) {
  for (size_t axis = 0; axis < 3; ++axis) {
    const float lower = value_at(bounds, bounds.lower[axis], i);
    if (!(lower <= value_at(bounds, bounds.upper[axis], i))) return false;
  }
  return true;
}

}  // namespace carom
