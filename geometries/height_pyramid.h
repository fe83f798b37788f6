// The lowest and highest heights of blocks of cells of a height field, and of blocks of such
// blocks.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "carom/shapes/height_field_geometry.h"

namespace carom {

// The heights of some cells; empty if all are holes.
struct HeightRange {
  float low = INFINITY, high = -INFINITY;

  bool is_empty() const { return !(low <= high); }
};

class HeightPyramid {
 public:
  static constexpr uint32_t kCells = 8;   // along each side of a block of the lowest level
  static constexpr uint32_t kBlocks = 4;  // of a level, along each side of a block of the next one

  struct Level {
    uint32_t nx, ny;  // blocks
    uint32_t side;    // cells along each side of a block
    std::vector<HeightRange> ranges;

    const HeightRange& at(uint32_t i, uint32_t j) const { return ranges[size_t{j} * nx + i]; }
    HeightRange& at(uint32_t i, uint32_t j) { return ranges[size_t{j} * nx + i]; }
  };

  // Makes the levels of a field of so many cells, without heights.
  HeightPyramid(uint32_t cells_x, uint32_t cells_y);

  // The lowest first; the last one has one block.
  std::span<const Level> levels() const { return levels_; }
  const HeightRange& whole() const { return levels_.back().ranges[0]; }
  size_t bytes() const;

  // Takes the heights of the blocks of the lowest level with row `j`, columns [first_i, end_i).
  void take_blocks(const HeightFieldGeometry& field, uint32_t j, uint32_t first_i, uint32_t end_i);
  // Takes the heights of blocks of the other levels, above these of the lowest level.
  void take_upper(uint32_t first_i, uint32_t end_i, uint32_t first_j, uint32_t end_j);

 private:
  std::vector<Level> levels_;
};

}  // namespace carom
