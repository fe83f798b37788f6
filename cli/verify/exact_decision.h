// Whether two bodies overlap exactly as they are stored.
#pragma once

#include <cstdint>

#include "narrowphase/batch/stated_body.h"

namespace carom::cli {

// 1 or 0, proven in double precision or computed in exact arithmetic. Meshes and compounds by every
// pair of their triangles and children: what a compound's children are is said beside
// CompoundGeometry. The bodies must be valid.
uint8_t exact_decision(const StatedBody& a, const StatedBody& b);

}  // namespace carom::cli
