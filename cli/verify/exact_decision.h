// Decides whether two bodies overlap exactly as stored.
#pragma once

#include <cstdint>

#include "narrowphase/batch/stated_body.h"

namespace carom::cli {

// Returns 1 or 0, proven in double precision or computed in exact arithmetic. Tests every pair of
// triangles and children of meshes and compounds; CompoundGeometry defines a compound's children.
// The bodies must be valid.
uint8_t exact_decision(const StatedBody& a, const StatedBody& b);

}  // namespace carom::cli
