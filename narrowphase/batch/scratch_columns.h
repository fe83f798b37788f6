// Working memory for the results of a block of pairs, or of a part of it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "narrowphase/batch/batch.h"

namespace carom {

// Small enough for the scratch of a block to stay in L2, large enough to amortise a task.
inline constexpr size_t kPairsPerBlock = 1024;

struct ScratchColumns {
  std::array<uint8_t, kPairsPerBlock> overlap, status;
  std::array<std::array<float, kPairsPerBlock>, 10> floats;

  ResultColumns columns();
};

}  // namespace carom
