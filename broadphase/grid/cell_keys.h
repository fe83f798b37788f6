// Boxes -> the cells of their lower corners.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "broadphase/grid/cell_grid.h"

namespace carom {

// The greatest number of cells, by grid and axis, from the lower corner of a box to its upper one.
struct CellReach {
  std::array<std::array<float, 3>, CellGrids::kMost> cells{};

  void add(const CellReach& other);
};

// A cell, and how far a box reaches from it: up to three cells along the row, and whether into the
// next row and the next slab.
struct CellKey {
  static constexpr int kCellBits = 28;
  static constexpr std::array<int, 3> kReachShift = {28, 30, 31};
  uint32_t bits;

  uint32_t cell() const { return bits & ((1u << kCellBits) - 1); }
  uint32_t cells_along_row() const { return bits >> kReachShift[0] & 3; }
  bool reaches_next_row() const { return bits >> kReachShift[1] & 1; }
  bool reaches_next_slab() const { return bits >> kReachShift[2]; }
};

// Writes the cell of every box of a block to `keys`, or grids.cells for boxes that take no part.
// `keys` has room for whole vectors after the last box.
void find_cells(const BoxBlock& block, const CellGrids& grids, CellKey* keys, CellReach& reach);

// The cell of a coordinate along axis k. It never decreases as the coordinate grows, rounding
// included. So whatever overlaps a box on the axis has a point in the cells from the box's lower
// corner to its upper one.
inline uint32_t cell_along(const CellGrid& grid, size_t k, float coordinate) {
  const float cell = (coordinate - grid.origin[k]) * grid.scale[k];
  const auto last = static_cast<float>(grid.cells[k] - 1);
  const float at_least_0 = cell > 0 ? cell : 0;
  return static_cast<uint32_t>(at_least_0 < last ? at_least_0 : last);
}

}  // namespace carom
