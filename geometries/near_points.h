// Leaves out triangles that a plane keeps apart from points, and bounds the gaps of the others.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "geometries/near_triangles.h"
#include "geometries/seen_points.h"
#include "geometries/surface.h"

namespace carom {

// Triangles that may be near points.
struct NearPoints {
  static constexpr size_t kRoom = 8;  // a vector is stored as a whole

  size_t count;
  std::array<uint32_t, BoxTree::kMostAtOnce + kRoom> triangle;
  // A lower bound of the gap between each triangle and the hull of the points; below zero it is a
  // depth. It is the greatest gap along the normal of the triangle, the normals of its sides, and
  // some directions between, less its rounding; -infinity if it is not known.
  std::array<float, BoxTree::kMostAtOnce + kRoom> gap;
};

// Finds which of the triangles may have a gap of at most `most` to the hull of the points, in their
// order; in the units of the points. There are at most BoxTree::kMostAtOnce. The results are the
// same on every ISA.
void keep_near_points(const TriangleArrays& mesh, const SeenPoints& points, float most,
                      std::span<const uint32_t> triangles, NearPoints& near);
void keep_near_points(const Surface& surface, const SeenPoints& points, float most,
                      std::span<const uint32_t> triangles, NearPoints& near);

}  // namespace carom
