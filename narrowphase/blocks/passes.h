// All that a detail asks for of one batch: the test, and what it leaves to rows that need more.
#pragma once

#include "carom/results/tier.h"
#include "narrowphase/batch/scratch_columns.h"
#include "narrowphase/pairs/pair_kinds.h"

namespace carom {

// Runs `batch`, of at most kPairsPerBlock pairs, whose `out` has every column that the detail
// fills. `direction`: none, or of every row a direction in which the pair may be apart, as packed
// by packed_direction.h. At details with contacts it is tried first, and what was found is
// remembered; separate pairs must not be measured then.
void run_passes(const PairKind& kind, const Batch& batch, Measured measured, uint32_t* direction,
                const Accuracy& accuracy);

}  // namespace carom
