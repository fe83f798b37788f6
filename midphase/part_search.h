// Finds the pairs of parts of two bodies that are near each other; at least one body is made of
// parts.
#pragma once

#include "base/parallel.h"
#include "midphase/placed_part.h"

namespace carom {

// Receives parts that have no parts themselves.
using PartPairFound = FunctionRef<void(const PlacedPart& a, const PlacedPart& b)>;

// Finds all pairs of parts that are at most `reach` metres apart, and some that are further. Every
// pair that a test may find to be that near is among them, despite all rounding. A half-space is
// near everything that reaches below its plane.
void find_part_pairs(const PlacedPart& a, const PlacedPart& b, double reach, PartPairFound found);

// Finds one pair of parts that is about the nearest; none if one of the bodies has no parts.
void find_near_part_pair(const PlacedPart& a, const PlacedPart& b, PartPairFound found);

}  // namespace carom
