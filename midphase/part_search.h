// Finds the pairs of parts of two bodies that are near each other; at least one body is made of
// parts.
#pragma once

#include <cstdint>
#include <span>

#include "base/parallel.h"
#include "midphase/placed_part.h"

namespace carom {

// Two parts that have no parts themselves; or one and a surface, of which each of these triangles
// is meant; or two meshes, of which each of these pairs of triangles is meant.
struct NearParts {
  const PlacedPart& a;
  const PlacedPart& b;
  std::span<const uint32_t> triangles = {};
  std::span<const ItemPair> pairs = {};
  // A lower bound of each separation that a test of `triangles` or `pairs` may find, metres; empty:
  // not known.
  std::span<const float> least_separations = {};
  // Whether those that are found, now and later, hold the nearest parts of the two bodies.
  bool hold_nearest = false;
};

// Receives some pairs of parts. Returns how far apart others may be that still matter, metres; less
// than 0 if only those that cross by more do.
using NearPartsFound = FunctionRef<double(const NearParts&)>;

// How parts are told apart: by their boxes, or also by the planes of triangles where two meshes
// meet. Pairs whose boxes touch are near, so that the nearest of them bounds a distance.
enum class Apart { by_boxes, by_planes };

// Which pairs of parts are searched for.
struct PartsWanted {
  double reach = 0;  // metres
  Apart apart = Apart::by_boxes;
  // Whether only the deepest contact matters, or the least distance: others that certainly are not
  // it may be left out.
  bool deepest_alone = false;
};

// Finds all pairs of parts that are at most the reach apart, and some that are further. Every
// pair that a test may find to be that near is among them, despite all rounding. A half-space is
// near everything that reaches below its plane.
void find_part_pairs(const PlacedPart& a, const PlacedPart& b, const PartsWanted& wanted,
                     NearPartsFound found);

// A lower bound of the separation that a test of two parts may find, metres, by balls that hold
// them; -infinity if there are none.
float least_separation(const PlacedPart& a, const PlacedPart& b);

// Finds one pair of parts that is about the nearest; none if one of the bodies has no parts.
void find_near_part_pair(const PlacedPart& a, const PlacedPart& b, NearPartsFound found);

}  // namespace carom
