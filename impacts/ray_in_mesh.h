// A point that moves in a straight line, seen from a mesh of thin triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "midphase/placed_part.h"

namespace carom {

// A triangle that the point may touch, and the earliest time at which it may.
struct RayCandidate {
  uint32_t triangle;
  double earliest;
};

// What a search keeps between calls, so that it needs no new memory.
struct RayScratch {
  struct Step {
    float key;  // a lower bound of the time, after `first`, at which the ray meets the child
    uint32_t child;
  };
  std::vector<Step> steps;
  std::vector<RayCandidate> candidates;
};

// A ray in the frame of the mesh, cut to where it may touch the mesh's bounds. What is left is
// short, so float32 is exact enough for the walk through the tree.
struct RayInMesh {
  const MeshGeometry* mesh;
  bool one_sided;
  Double3 start, way;
  double travel, lengths;  // bounds on the coordinates of `way`, and on all coordinates
  double first, last;      // the times between which the ray is cut; empty if first > last

  // The point at `first`, grown by more than rounding; 1 / way. On an axis along which the point
  // hardly moves the box holds its whole path, and the inverse is infinite.
  std::array<float, 3> lower, upper, inverse;

  bool is_empty() const { return !(first <= last); }

  // Sets everything below `one_sided`. Only times up to `limit` count. False if the path is too
  // long for float32.
  bool set(const Double3& from, const Double3& displacement, double limit);
};

// Finds the triangles that the ray may touch first, into scratch.candidates: those whose earliest
// time is at most `limit`, or at most the time of the first triangle that it certainly touches. The
// kernels of linear times decide which it is. With `any` the search ends, and returns true, at a
// triangle that the ray certainly touches.
bool find_candidates(const RayInMesh& ray, double limit, bool any, RayScratch& scratch);

}  // namespace carom
