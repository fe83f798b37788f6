// World bounds of a few bodies among many.
#pragma once

#include <cstdint>
#include <span>

#include "carom/bounds/bounds.h"

namespace carom {

// Writes the bounds of the bodies at these indices as compute_bounds() does, one body at a time.
void compute_some_bounds(const Collidables& bodies, std::span<const uint32_t> indices,
                         const BoundsColumns& out);

}  // namespace carom
