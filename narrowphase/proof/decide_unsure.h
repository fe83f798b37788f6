// Decides the rows that are unsure in float32, with a proof.
#pragma once

#include "carom/results/tier.h"
#include "narrowphase/batch/batch.h"
#include "narrowphase/pairs/pair_kinds.h"

namespace carom {

// Decides the rows that batch.unsure marks; their bodies must be valid. Writes the overlap, and
// corrects the sign of the separation if the batch has one.
void decide_unsure(const PairKind& kind, const Batch& batch, Tier tier);

}  // namespace carom
