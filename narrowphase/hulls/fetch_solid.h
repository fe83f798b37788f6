// Asks for what the search over separating axes reads of the hull of a k-DOP. Each step reads what
// the one before asked for, and would wait for it.
#pragma once

#include <cstddef>

#include "base/fetch_ahead.h"
#include "shapes/dop_solid.h"

namespace carom {

// The steps, in their order.
inline constexpr size_t kFetchSteps = 2;

[[gnu::always_inline]] inline void fetch_solid(const HullGeometry& hull, size_t step) {
  if (step == 0) return fetch_lines(&hull, sizeof hull);
  if (const DopSolid* const solid = hull.dop_solid()) fetch_lines(solid, sizeof *solid);
}

}  // namespace carom
