// Grids of cells that boxes are sorted into, by their lower corners. A grid's cells are at least as
// large as its boxes, so that a box reaches into the next cell at most; along the rows cells may be
// half as long, and a box reaches into the next but one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "broadphase/grid/survey.h"

namespace carom {

// Cells run along axis[0] in rows, rows along axis[1] in slabs, slabs along axis[2]. Behind every
// row follow empty cells (as many as a box reaches), behind the rows of a slab an empty row, behind
// the slabs an empty slab: neighbours need no test of whether they exist.
struct CellGrid {
  std::array<float, 3> origin{};
  std::array<float, 3> scale{};     // cells a metre
  std::array<uint32_t, 3> cells{};  // along axis[0], axis[1], axis[2]; at least 1
  std::array<uint32_t, 3> reach{};  // how many cells further a box may reach
  uint32_t first_cell = 0;          // in the directory that all grids share
  uint32_t row_stride = 0;          // from a cell to the one of the next row, and of the next slab
  uint32_t slab_stride = 0;
  float largest_edge = 0;  // boxes with longer edges belong to another grid
  bool is_coarse = false;  // cells much larger than the boxes, lest they be too many

  uint32_t cell_at(uint32_t x, uint32_t y, uint32_t z) const {
    return first_cell + z * slab_stride + y * row_stride + x;
  }

  // Offsets to the rows ahead that a box can reach into, besides its own: the next row of the
  // slab, if there are several, and then three of the next slab.
  struct RowsAhead {
    std::array<uint32_t, 4> offset{};
    size_t in_slab = 0;  // how many are in the same slab
    size_t count = 0;
  };
  RowsAhead rows_ahead() const;
};

// One grid for boxes of one size, a few where sizes differ much, from small boxes to large ones.
struct CellGrids {
  static constexpr size_t kMost = 12;

  std::array<uint8_t, 3> axis{0, 1, 2};
  std::array<CellGrid, kMost> grid;
  size_t count = 0;
  uint32_t cells = 0;  // of all grids with their empty ones; the cell of boxes that take no part

  // Lays grids out for these boxes. `cell_scale[k]` enlarges the cells along axis k.
  void choose(const Survey& survey, const BoxSource& source,
              const std::array<float, 3>& cell_scale);
};

}  // namespace carom
