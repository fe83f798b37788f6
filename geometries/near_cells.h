// Leaves out triangles of height fields that a plane keeps apart from a ball or a box, and bounds
// the gaps of the others.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "carom/base/function_ref.h"
#include "geometries/height_search.h"
#include "geometries/near_points.h"

namespace carom {

// So many cells along each side a window may have.
inline constexpr uint32_t kMostCellsOfWindow = 32;

// The middle of a ball, or a box, in the frame of a height field, metres.
struct SeenSolid {
  Double3 middle;
  bool is_box = false;
  std::array<Double3, 3> axis{};  // unit vectors along the sides of the box
  Double3 half{};                 // of the sides

  // The lengths that the kernel takes.
  static constexpr double kLeast = 0x1p-30, kMost = 0x1p30;
};

// Which triangles are wanted, metres.
struct GapsWanted {
  double most;  // the gap may be so much
  // Where a ball is nearest to the inside of a triangle, and others are further by more than this,
  // those may be left out.
  double ties = HUGE_VAL;
};

// Calls `found` with the triangles of the window that are wanted, some at a time. The gaps
// (NearPoints::gap) are lower bounds, less their rounding: that along the normal of the triangle,
// those along the sides of the box and the axes of the field, and for a ball the distance that
// follows from both. The spacing of the field, and the size of the solid are within
// SeenSolid::kLeast and kMost or zero; the middle is at most SeenSolid::kMost from the field. The
// results are the same on every ISA.
void find_near_cells(const HeightFieldGeometry& field, const CellRange& window,
                     const SeenSolid& solid, const GapsWanted& wanted,
                     FunctionRef<void(const NearPoints& near)> found);

}  // namespace carom
