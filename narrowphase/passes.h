// All that a detail asks for of one batch: the test, and what it leaves to rows that need more.
#pragma once

#include "carom/kernel/tier.h"
#include "narrowphase/batch.h"
#include "narrowphase/pair_kinds.h"

namespace carom {

// Small enough for the scratch of a block to stay in L2, large enough to amortise a task.
inline constexpr size_t kPairsPerBlock = 1024;

// Results of a block or a part of it.
struct ScratchColumns {
  std::array<uint8_t, kPairsPerBlock> overlap, status;
  std::array<std::array<float, kPairsPerBlock>, 10> floats;

  ResultColumns columns();
};

// Runs `batch`, of at most kPairsPerBlock pairs, whose `out` has every column that the detail
// fills. `direction`: none, or of every row a direction in which the pair may be apart, as packed
// by packed_direction.h. At details with contacts it is tried first, and what was found is
// remembered; separate pairs must not be measured then.
void run_passes(const PairKind& kind, const Batch& batch, Measured measured, uint32_t* direction,
                const Accuracy& accuracy);

}  // namespace carom
