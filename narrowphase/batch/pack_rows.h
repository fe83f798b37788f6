// Packs the rows of columns that are wanted, a vector at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "carom/results/pair.h"

namespace carom {

// A column, and where its wanted rows go.
struct PackedColumn {
  const float* from;
  float* to;
};

// Where the wanted pairs, and their numbers, go.
struct PackedRows {
  const Pair* pairs;
  Pair* to;
  uint16_t* rows;
};

// Packs the rows of [0, count) whose byte in `wanted` is 1, in their order, and returns how many
// there are. What it writes to needs room for all rows and kMostLanes more.
size_t pack_rows(const uint8_t* wanted, size_t count, const PackedRows& rows,
                 std::span<const PackedColumn> columns);

}  // namespace carom
