// Grids of cells. Boxes are sorted into them by their lower corners. The cells of a grid are at
// least as large as its boxes, so a box reaches at most into the next cell. Along the rows cells
// may be half as long; a box then reaches at most into the next but one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "broadphase/grid/survey.h"

namespace carom {

// Cells run along axis[0] in rows, rows along axis[1] in slabs, slabs along axis[2]. Every row ends
// with empty cells (as many as a box reaches), every slab with an empty row, the grid with an empty
// slab, so that a search need not test whether a neighbour exists.
struct CellGrid {
  std::array<float, 3> origin{};
  std::array<float, 3> scale{};     // cells a metre
  std::array<uint32_t, 3> cells{};  // along axis[0], axis[1], axis[2]; at least 1
  std::array<uint32_t, 3> reach{};  // by how many cells a box may reach beyond its own
  uint32_t first_cell = 0;          // in the numbering that all grids share
  // from a cell to the same cell of the next row, and below of the next slab
  uint32_t row_stride = 0;
  uint32_t slab_stride = 0;
  float largest_edge = 0;  // boxes with longer edges belong to another grid
  bool is_coarse = false;  // cells are much larger than the boxes, which keeps down their number

  uint32_t cell_at(uint32_t x, uint32_t y, uint32_t z) const {
    return first_cell + z * slab_stride + y * row_stride + x;
  }

  // Offsets from a cell to the rows ahead that a box can reach into, besides its own: the next row
  // of the slab, if there are several, and then three of the next slab.
  struct RowsAhead {
    std::array<uint32_t, 4> offset{};
    size_t in_slab = 0;  // how many are in the same slab
    size_t count = 0;
  };
  RowsAhead rows_ahead() const;
};

// The grids of a search, from small boxes to large ones: one for boxes of similar size, a few where
// sizes differ much.
struct CellGrids {
  static constexpr size_t kMost = 12;

  std::array<uint8_t, 3> axis{0, 1, 2};
  std::array<CellGrid, kMost> grid;
  size_t count = 0;
  // cells of all grids, empty ones included; also the cell of boxes that take no part
  uint32_t cells = 0;

  // Lays out grids for these boxes. `cell_scale[k]` enlarges the cells along axis k.
  void choose(const Survey& survey, const BoxSource& source,
              const std::array<float, 3>& cell_scale);
};

}  // namespace carom
