// Boxes in the order of a search: six columns, and the body of each row.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "broadphase/box_source.h"

namespace carom {

// Axis 0 is the one that is swept. After the last row follow kPadding rows of NaN, which overlap
// nothing, so that whole vectors can be read.
struct BoxColumns {
  static constexpr size_t kPadding = 16;

  std::array<std::vector<float>, 3> lower;
  std::array<std::vector<float>, 3> upper;
  std::vector<uint32_t> body;
  size_t count = 0;

  // Fills row i with box body[i] of `bounds`, with axes in the order first_axis, first_axis + 1,
  // ...
  void fill(const BoundsView& bounds, size_t first_axis, Parallelism parallelism);

  size_t bytes() const;
};

}  // namespace carom
