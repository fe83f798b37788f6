// Finds triangles of height fields. Those that touch a box are the ones that the tree of a mesh of
// the same triangles would find.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/parallel.h"
#include "carom/shapes/height_field_geometry.h"
#include "geometries/height_pyramid.h"
#include "trees/tree.h"

namespace carom {

// Whether all cells are holes.
inline bool is_empty(const HeightFieldGeometry& field) {
  return field.pyramid().whole().is_empty();
}

// As BoxTree::find_touching(). The triangles and their order are the same on every ISA.
void find_touching(const HeightFieldGeometry& field, const RoundedBox& box, ItemsFound found);

// Whether a block of cells touches the box.
bool may_touch(const HeightFieldGeometry& field, const TreeBox& box);

// Cells [first_i, end_i) x [first_j, end_j).
struct CellRange {
  uint32_t first_i, end_i, first_j, end_j;

  bool is_empty() const { return first_i >= end_i || first_j >= end_j; }
  uint64_t count() const { return uint64_t{end_i - first_i} * (end_j - first_j); }
};

// The cells over or under a box, and some beside it.
CellRange cells_at(const HeightFieldGeometry& field, const Double3& lower, const Double3& upper);

// As BoxTree::find_below().
void find_below(const HeightFieldGeometry& field, const Double3& normal, double limit,
                FunctionRef<void(uint32_t triangle)> found);

// The triangles whose boxes `admits` takes, some at a time. It must take every box that holds one
// that it takes.
void find_admitted(const HeightFieldGeometry& field, FunctionRef<bool(const TreeBox& box)> admits,
                   ItemsFound found);

// As BoxTree::near_item() and low_item(). The field must not be empty.
uint32_t near_triangle(const HeightFieldGeometry& field, const TreeBox& box);
uint32_t low_triangle(const HeightFieldGeometry& field, const Double3& normal);

}  // namespace carom
