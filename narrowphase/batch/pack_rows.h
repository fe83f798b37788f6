// Packs the rows of columns that are wanted, a vector at a time: which they are cannot be
// predicted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "carom/results/pair.h"

namespace carom {

// A column, and where the numbers of its wanted rows go.
struct PackedColumn {
  const float* from;
  float* to;
};

// Pairs, and where those of the wanted rows and the numbers of these rows go.
struct PackedPairs {
  const Pair* from;
  Pair* to;
  uint16_t* row_numbers;
};

// Packs the rows of [0, count) whose byte in `wanted` is 1, in their order, and returns how many
// there are. It may write to any of the first `count` places.
size_t pack_rows(const uint8_t* wanted, size_t count, const PackedPairs& pairs,
                 std::span<const PackedColumn> columns);

}  // namespace carom
