// Runs all passes that a detail needs on one batch.
#pragma once

#include "carom/results/tier.h"
#include "narrowphase/batch/column_memory.h"
#include "narrowphase/pairs/pair_kinds.h"

namespace carom {

// Runs `batch` of at most kPairsPerBlock pairs; its `out` has every column that the detail fills.
// `direction`: nullptr, or for every row a direction in which the pair may be separate
// (packed_direction.h). At details with contacts the direction pass tests it first, and
// run_passes() writes the new directions back; `measured` must then be Measured::overlapping.
void run_passes(const PairKind& kind, const Batch& batch, Measured measured, uint32_t* direction,
                const Accuracy& accuracy);

}  // namespace carom
