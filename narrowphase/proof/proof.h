// Tries to prove in double precision whether two shapes overlap, exactly as they are stored.
#pragma once

#include <cstdint>

#include "narrowphase/batch/stated_body.h"

namespace carom {

// 1 overlap, 0 separate, kUndecided. Never wrong: it trusts a result only if the margin exceeds
// every rounding error that may have gone into it.
uint8_t prove_overlap(const StatedBody& a, const StatedBody& b);

}  // namespace carom
