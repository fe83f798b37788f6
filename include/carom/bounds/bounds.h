// Bodies -> world bounds, rounded outwards so that no pair is ever lost.
#pragma once

#include <array>
#include <cstddef>

#include "carom/base/parallelism.h"
#include "carom/export.h"
#include "carom/shapes/views.h"

namespace carom {

// Six dense columns to write bounds to, one entry a body.
struct BoundsColumns {
  std::array<float*, 3> lower{};
  std::array<float*, 3> upper{};
};

// Writes the closed bounds of every body: a float32 box that contains the shape. Of spheres and
// aabbs it is the smallest one (exact corners where they are floats), of shapes that are turned at
// most a few floats larger, of half-spaces -inf to +inf. A body with NaN, infinity, a negative
// size, or a quaternion or normal of zero gets an empty box (lower = +inf, upper = -inf), which
// meets nothing. Returns the number of such bodies.
CAROM_EXPORT size_t compute_bounds(const Collidables& bodies, const BoundsColumns& out,
                                   Parallelism parallelism = Parallelism::none);

}  // namespace carom
