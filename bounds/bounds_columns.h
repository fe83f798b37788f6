// The block size of the loop over bounds.
#pragma once

#include <cstddef>

namespace carom {

// Bodies a block: a multiple of every lane count, so that only the last block has a tail.
inline constexpr size_t kBodiesPerBlock = 1024;

}  // namespace carom
