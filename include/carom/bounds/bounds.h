/// @file
/// World bounds of bodies: axis-aligned boxes, rounded outwards so that no pair is ever lost.
#pragma once

#include <array>
#include <cstddef>

#include "carom/base/parallelism.h"
#include "carom/export.h"
#include "carom/shapes/views.h"

namespace carom {

/// Six dense columns that compute_bounds() writes to, one entry a body; world frame, metres.
struct BoundsColumns {
  std::array<float*, 3> lower{};  ///< lower ends in x, y and z
  std::array<float*, 3> upper{};  ///< upper ends in x, y and z
};

/// Writes the closed bounds of every body: a float32 box that contains the shape. Spheres and aabbs
/// get the smallest such box (exact corners where these are floats), shapes with an orientation
/// one that is at most a few floats larger, half-spaces -inf to +inf. A body with NaN, infinity, a
/// negative size, or a quaternion or normal of zero gets an empty box (lower = +inf,
/// upper = -inf), which overlaps nothing. Returns the number of such bodies.
CAROM_EXPORT size_t compute_bounds(const Collidables& bodies, const BoundsColumns& out,
                                   Parallelism parallelism = Parallelism::none);

}  // namespace carom
