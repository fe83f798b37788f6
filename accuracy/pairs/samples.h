// Random pairs to measure. Triangles are two-sided and thin; shapes are 0.5 to 2 m large with an
// aspect of up to 4.
#pragma once

#include <cstddef>
#include <vector>

#include "accuracy/pairs/oracle_pairs.h"

namespace carom::accuracy {

// Half of the pairs overlap, in random order; all have bounds near each other. Positions are
// float32 within 100 m of the origin, orientations unit quaternions.
std::vector<ConvexPair> random_pairs(const KindPair& kinds, size_t count, uint64_t seed);

// A at the origin, B near it with a random orientation.
std::vector<ConvexPair> loose_pairs(const KindPair& kinds, size_t count, uint64_t seed);

// Like loose_pairs(), but the orientations differ by this angle only, about an axis of the body or
// a random one, and most edges are along the body's axes. The pairs overlap by up to a third of
// their size or are as far apart.
std::vector<ConvexPair> near_parallel_pairs(const KindPair& kinds, double angle, size_t count,
                                            uint64_t seed);
// Whether an angle between the two shapes has a meaning.
bool has_angle(const KindPair& kinds);

// Moves B (float64 position) along the normal until the signed distance is `gap`, up to the
// rounding of its position. Returns false if that is impossible.
bool move_to_gap(ConvexPair& pair, long double gap);

// The mean bounding radius; with a half-space the other shape's radius.
double size_of(const ConvexPair& pair);

}  // namespace carom::accuracy
