#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "broadphase/grid/cell_keys.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <algorithm>

#include "broadphase/grid/cell_keys.h"
#include "broadphase/grid/edge-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// cell_along() in lanes.
HWY_INLINE I cells_along(const CellGrid& grid, size_t k, F coordinate) {
  const F cell = hn::Mul(hn::Sub(coordinate, splat(grid.origin[k])), splat(grid.scale[k]));
  const F last = splat(static_cast<float>(grid.cells[k] - 1));
  return hn::ConvertTo(IntTag(), min(max(cell, splat(0)), last));
}

void find_cells(const BoxBlock& block, const CellGrids& grids, CellKey* out, CellReach& reach) {
  const FloatTag tag;
  const IntTag bits;
  I farthest[CellGrids::kMost][3];
  for (size_t g = 0; g < grids.count; ++g) {
    for (size_t k = 0; k < 3; ++k) farthest[g][k] = hn::Zero(bits);
  }
  for (size_t i = 0; i < block.count; i += kLanes) {
    F lower[3], upper[3];
    for (size_t k = 0; k < 3; ++k) {
      lower[k] = hn::LoadU(tag, block.lower[grids.axis[k]] + i);
      upper[k] = hn::LoadU(tag, block.upper[grids.axis[k]] + i);
    }
    Mask open = hn::And(hn::And(hn::Le(lower[0], upper[0]), hn::Le(lower[1], upper[1])),
                        hn::Le(lower[2], upper[2]));
    const F longest = max(max(edge_of(lower[0], upper[0]), edge_of(lower[1], upper[1])),
                          edge_of(lower[2], upper[2]));
    I cell = hn::Set(bits, static_cast<int32_t>(grids.cells));
    for (size_t g = 0; g < grids.count; ++g) {
      const CellGrid& grid = grids.grid[g];
      const auto mine =
          hn::RebindMask(bits, hn::And(open, hn::Le(longest, splat(grid.largest_edge))));
      open = hn::AndNot(hn::Le(longest, splat(grid.largest_edge)), open);
      I c[3];
      I reaches = hn::Zero(bits);
      for (size_t k = 0; k < 3; ++k) {
        c[k] = cells_along(grid, k, lower[k]);
        const I further = hn::IfThenElseZero(mine, hn::Sub(cells_along(grid, k, upper[k]), c[k]));
        farthest[g][k] = hn::Max(farthest[g][k], further);
        reaches = hn::Or(reaches, hn::ShiftLeftSame(further, CellKey::kReachShift[k]));
      }
      const I row = hn::Add(hn::Mul(c[2], hn::Set(bits, static_cast<int32_t>(grid.slab_stride))),
                            hn::Mul(c[1], hn::Set(bits, static_cast<int32_t>(grid.row_stride))));
      const I index =
          hn::Add(hn::Add(row, c[0]), hn::Set(bits, static_cast<int32_t>(grid.first_cell)));
      cell = hn::IfThenElse(mine, hn::Or(index, reaches), cell);
    }
    hn::StoreU(cell, bits, reinterpret_cast<int32_t*>(out + i));
  }
  for (size_t g = 0; g < grids.count; ++g) {
    for (size_t k = 0; k < 3; ++k) {
      HWY_ALIGN int32_t lanes[kLanes];
      hn::Store(farthest[g][k], bits, lanes);
      for (size_t lane = 0; lane < kLanes; ++lane) {
        reach.cells[g][k] = std::max(reach.cells[g][k], static_cast<float>(lanes[lane]));
      }
    }
  }
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(find_cells);

}  // namespace

void CellReach::add(const CellReach& other) {
  for (size_t g = 0; g < cells.size(); ++g) {
    for (size_t k = 0; k < 3; ++k) cells[g][k] = std::max(cells[g][k], other.cells[g][k]);
  }
}

void find_cells(const BoxBlock& block, const CellGrids& grids, CellKey* keys, CellReach& reach) {
  CAROM_DISPATCH(find_cells)(block, grids, keys, reach);
}

}  // namespace carom
#endif  // HWY_ONCE
