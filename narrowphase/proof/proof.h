// Whether two shapes overlap exactly as they are stored, proven in double precision where that can.
#pragma once

#include <cstdint>

#include "narrowphase/batch/stated_body.h"

namespace carom {

// 1 overlap, 0 separate, kUndecided. Never wrong: what was found is only believed if it holds by
// more than all that rounding may have done to it.
uint8_t prove_overlap(const StatedBody& a, const StatedBody& b);

}  // namespace carom
