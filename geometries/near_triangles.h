// Leaves out pairs of triangles that the plane of one keeps apart.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "carom/shapes/mesh_geometry.h"
#include "trees/pair_scale.h"
#include "trees/tree.h"

namespace carom {

// The triangles of a mesh, as lanes read them.
struct TriangleArrays {
  const float* vertices;  // three numbers each; one more number follows the last vertex
  const std::array<uint32_t, 3>* triangles;
  size_t count;
};

inline TriangleArrays arrays_of(const MeshGeometry& mesh) {
  return {mesh.vertices().data()->data(), mesh.triangles().data(), mesh.triangles().size()};
}

// Moves the pairs of triangles that may be within `reach` to the front, in their order, and returns
// how many they are. The others are further apart along the normal of one of the two triangles.
// `gaps`: for each pair that is kept, the gap along that normal, a lower bound of their separation.
// `reach` and gaps in units of `scale`, less than 0 for triangles that cross; gaps are exact to its
// slack. The same on every ISA.
size_t keep_near(const TriangleArrays& a, const TriangleArrays& b, const FrameChange& b_to_a,
                 const PairScale& scale, float reach, std::span<ItemPair> pairs, float* gaps);

}  // namespace carom
