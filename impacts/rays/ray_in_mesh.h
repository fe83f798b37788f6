// A point that moves in a straight line, seen from a mesh of thin triangles.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "impacts/slack.h"
#include "midphase/placed_part.h"

namespace carom {

// A triangle that the point may touch, and the earliest time at which it may.
struct RayCandidate {
  uint32_t triangle;
  double earliest;
};

// A mesh that rays may touch.
struct RayTarget {
  const MeshGeometry* mesh;
  bool one_sided;
  Double3 lower, upper;  // its bounds
  double greatest;       // of all coordinates

  RayTarget(const MeshGeometry& of_mesh, bool is_one_sided);
};

// Points that move in straight lines, as columns.
struct RayColumns {
  static constexpr size_t kMost = 64;
  // Kernels read whole vectors from any row on.
  using Column = std::array<double, kMost + 8>;

  std::array<Column, 3> from, way;  // of the mesh, from the point
  Column limit;                     // only times up to it count
};

// Whether float32 holds such a ray where it may touch the mesh.
inline bool is_in_range(const RayTarget& target, const Double3& from, const Double3& way) {
  // Cut and turned, the ray is at most a few times as long as the longest of these.
  return std::max({greatest(from), greatest(way), target.greatest}) < kLongestPath / 16;
}

// A ray in the frame of the mesh, cut to where it may touch the mesh's bounds. What is left is
// short, so float32 is exact enough for the walk through the tree.
struct RayInMesh {
  const MeshGeometry* mesh;
  bool one_sided;
  Double3 start, way;
  double travel, lengths;  // bounds on the coordinates of `way`, and on all coordinates
  double first, last;      // the times between which the ray is cut

  // The point at `first`, grown by more than rounding; 1 / way. On an axis along which the point
  // hardly moves the box holds its whole path, and the inverse is infinite.
  std::array<float, 3> lower, upper, inverse;
};

// A search for the triangles that a ray may touch first.
struct RaySearch {
  RayInMesh ray;
  size_t row;    // of the columns
  double limit;  // later times are of no use
  // Triangles whose earliest time is at most the limit, and at most the time of the first triangle
  // that the ray certainly touches. The kernels of linear times decide which it is.
  std::vector<RayCandidate> candidates;
  bool is_sure;  // it certainly touches one by the limit
};

// Cuts rows [begin, end), which are in range, of rays at one mesh whose rotation is `turn`. Starts
// the searches of those that may touch the mesh's bounds, in their order, and returns how many.
size_t cut_rays(const RayTarget& target, const Turn& turn, const RayColumns& rays, size_t begin,
                size_t end, RaySearch* searches);

// Searches for many rays side by side, so that they wait for memory together. With `any` a search
// ends at a triangle that its ray certainly touches.
void find_candidates(std::span<RaySearch> searches, bool any);

}  // namespace carom
