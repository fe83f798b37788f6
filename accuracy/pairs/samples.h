// Random pairs to measure on. Triangles are plain ones; shapes are 0.5 to 2 m large with an aspect
// of up to 4.
#pragma once

#include <cstddef>
#include <vector>

#include "accuracy/pairs/oracle_pairs.h"

namespace carom::accuracy {

// As many overlapping as separate pairs, in random order, their bounds near each other; positions
// are float32 within 100 m of the origin, orientations unit quaternions.
std::vector<ConvexPair> random_pairs(const KindPair& kinds, size_t count, uint64_t seed);

// A at the origin and B turned any way, somewhere near it.
std::vector<ConvexPair> loose_pairs(const KindPair& kinds, size_t count, uint64_t seed);

// The same, but that the two are turned against each other by this angle only, about an axis of
// the body or any other, and that most edges are along the axes of the body: they overlap by up to
// a third of their size or are as far apart.
std::vector<ConvexPair> near_parallel_pairs(const KindPair& kinds, double angle, size_t count,
                                            uint64_t seed);
// Whether an angle between the two means anything.
bool has_angle(const KindPair& kinds);

// Moves B (float64) along the normal until the signed distance is this one but for the rounding of
// its position; false if it cannot be had.
bool move_to_gap(ConvexPair& pair, long double gap);

// The mean bounding radius; of half-spaces that of the other shape.
double size_of(const ConvexPair& pair);

}  // namespace carom::accuracy
