// Bodies of a block in the loop over bounds.
#pragma once

#include <cstddef>

namespace carom {

// A multiple of every lane count, so that only the last block has a tail.
inline constexpr size_t kBodiesPerBlock = 1024;

}  // namespace carom
