// Which triangles of a mesh share their edges.
#pragma once

#include <cstdint>

#include "carom/base/function_ref.h"
#include "carom/shapes/mesh_geometry.h"

namespace carom {

// The edge of a triangle from corner `index` to the next.
struct TriangleEdge {
  uint32_t triangle;
  uint8_t index;
};

// Calls use(edge, the same edge of the other triangle) for each side of every edge that exactly two
// triangles with an area share. Vertices at one place count as one.
void for_each_shared_edge(
    const MeshGeometry& mesh,
    FunctionRef<void(const TriangleEdge& own, const TriangleEdge& other)> use);

}  // namespace carom
