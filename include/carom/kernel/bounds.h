// Bodies -> world bounds, rounded outwards so that no pair is ever lost.
#pragma once

#include <array>
#include <cstddef>

#include "carom/export.h"
#include "carom/kernel/parallelism.h"
#include "carom/kernel/views.h"

namespace carom {

// Six dense columns to write bounds to, one entry a body.
struct BoundsColumns {
  std::array<float*, 3> lower{};
  std::array<float*, 3> upper{};
};

// Writes the closed bounds of every body: the smallest float32 box that contains the shape (exact
// corners where they are floats). A body with NaN, infinity or a negative size gets an empty box
// (lower = +inf, upper = -inf), which meets nothing. Returns the number of such bodies.
// Kinds: sphere, aabb.
CAROM_EXPORT size_t compute_bounds(const Collidables& bodies, const BoundsColumns& out,
                                   Parallelism parallelism = Parallelism::none);

}  // namespace carom
