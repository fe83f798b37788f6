// The corners of a k-DOP in exact numbers.
#pragma once

#include <vector>

#include "base/dyadic.h"
#include "carom/shapes/dop.h"
#include "narrowphase/scalar/vector_of.h"

namespace carom {

// Every corner is a quotient by this or a divisor of it: three of the slabs' directions span a
// volume of 1, 2, 3 or 4.
inline constexpr int kDopUnit = 12;

// Each corner once, times kDopUnit; at least one of a valid k-DOP. Slabs that have no point in
// common count as half a unit in the last place wider at both ends, as everywhere, or if that is
// not enough (where an end is zero) wider by that share of the k-DOP's size.
std::vector<VectorOf<Dyadic>> exact_corners(const Dop& dop);

}  // namespace carom
