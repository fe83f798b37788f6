// The corners of a k-DOP in exact numbers.
#pragma once

#include <vector>

#include "base/dyadic.h"
#include "carom/shapes/dop.h"
#include "narrowphase/scalar/vector_of.h"

namespace carom {

// The denominator of every corner divides this number: three slab directions span a volume of 1, 2,
// 3 or 4.
inline constexpr int kDopUnit = 12;

// Each corner once, times kDopUnit; a valid k-DOP has at least one. Slabs without a common point
// count as half a unit in the last place wider at both ends, as everywhere in the library. If that
// is not enough (where an end is zero), they count as wider by that share of the k-DOP's size.
std::vector<VectorOf<Dyadic>> exact_corners(const Dop& dop);

}  // namespace carom
