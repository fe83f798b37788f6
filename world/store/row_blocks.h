// How many rows of bodies a task takes at a time.
#pragma once

#include <cstddef>

namespace carom {

// Few enough that a single changed body costs little, enough for an efficient loop over blocks.
inline constexpr size_t kRowsPerBlock = 1024;

}  // namespace carom
