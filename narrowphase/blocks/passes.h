// Runs all passes that a detail needs on one batch.
#pragma once

#include "carom/results/tier.h"
#include "narrowphase/batch/column_memory.h"
#include "narrowphase/blocks/kept_shells.h"
#include "narrowphase/pairs/pair_kinds.h"

namespace carom {

// The pairs of a batch remember this from step to step, at details with contacts and with
// Measured::overlapping.
struct PairMemory {
  // nullptr, or for every row a direction in which the pair may be separate (packed_direction.h).
  // The direction pass tests it first, and run_passes() writes the new directions back.
  uint32_t* direction = nullptr;
  // nullptr, or the shells of pairs that overlap. Depths within the tolerance are proved by them.
  KeptShells* shells = nullptr;
};

// Runs `batch` of at most kPairsPerBlock pairs; its `out` has every column that the detail fills.
void run_passes(const PairKind& kind, const Batch& batch, Measured measured,
                const PairMemory& memory, const Accuracy& accuracy);

}  // namespace carom
