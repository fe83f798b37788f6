// Decisions that float32 did not make beyond doubt, made again with a proof.
#pragma once

#include "carom/results/tier.h"
#include "narrowphase/batch/batch.h"
#include "narrowphase/pairs/pair_kinds.h"

namespace carom {

// Of the rows that batch.unsure marks; their bodies are valid. Overlaps are written, and the sign
// of the separation follows where that is there.
void decide_unsure(const PairKind& kind, const Batch& batch, Tier tier);

}  // namespace carom
