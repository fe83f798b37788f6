// Asks for what the search over separating axes reads of a hull. A hull's numbers lie in several
// places of which each is known from the one before, and the search would wait for each in turn.
#pragma once

#include <cstddef>

#include "base/fetch_ahead.h"
#include "shapes/hull_features.h"

namespace carom {

// The steps, in their order. Each reads what the one before asked for.
inline constexpr size_t kFetchSteps = 3;

[[gnu::always_inline]] inline void fetch_solid(const HullGeometry& hull, size_t step) {
  if (step == 0) return fetch_lines(&hull, sizeof hull);
  const HullFeatures* const features = hull.features();
  if (!features) return;
  if (step == 1) {
    fetch_lines(features, sizeof *features);
    fetch_lines(hull.column(0), 3 * padded_count(hull.points().size()) * sizeof(float));
  } else {
    fetch_lines(features->column(0), 4 * padded_count(features->face_count()) * sizeof(float));
    fetch_lines(features->planes().data(), features->planes().size_bytes());
    fetch_lines(features->sides(0), 2 * features->side_bytes());
  }
}

}  // namespace carom
