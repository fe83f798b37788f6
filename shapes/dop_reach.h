// How far a k-DOP reaches along a direction, without its corners.
#pragma once

#include <optional>

#include "shapes/dop_polytope.h"

namespace carom {

// The greatest d . x of all points x of the slabs, whose axes are tight (with_tight_axes()). It is
// never less than that, but for the rounding of its sums. std::nullopt if rounding leaves no point,
// or hides the way: the corners then tell.
std::optional<double> dop_reach(const DopSlabs& tight, const Double3& d);

}  // namespace carom
