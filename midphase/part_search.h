// Two bodies, at least one of which is made of parts -> the pairs of their parts that are near each
// other.
#pragma once

#include "base/parallel.h"
#include "midphase/placed_part.h"

namespace carom {

// Parts that have no parts themselves.
using PartPairFound = FunctionRef<void(const PlacedPart& a, const PlacedPart& b)>;

// All pairs of parts that are no further apart than `reach` in metres, and some that are: what a
// test may find to be that near is among them, whatever it rounds. Half-spaces are near all that
// reaches below their plane.
void find_part_pairs(const PlacedPart& a, const PlacedPart& b, double reach, PartPairFound found);

// One pair of parts that are probably about the nearest; none if one of the bodies has no parts.
void find_near_part_pair(const PlacedPart& a, const PlacedPart& b, PartPairFound found);

}  // namespace carom
