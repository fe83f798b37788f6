// Boxes with their cells, as records that a sort can move; and their way back to columns.
#pragma once

#include <cstddef>
#include <cstdint>

#include "broadphase/grid/cell_keys.h"

namespace carom {

struct alignas(32) BoxRecord {
  float lower[3], upper[3];
  uint32_t body;
  CellKey key;
};

// Where rows are written. Column k of the corners (lower 0 to 2, upper 3 to 5) begins k * stride
// after the first.
struct RowColumns {
  float* corners;
  size_t stride;
  uint32_t* body;
  CellKey* key;
};

// Writes records[order[i]] to row i of the columns, for i in [0, count).
void write_columns(const BoxRecord* records, const uint32_t* order, size_t count,
                   const RowColumns& columns);

}  // namespace carom
