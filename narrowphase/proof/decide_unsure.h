// Decides the rows that are unsure in float32, with a proof.
#pragma once

#include "carom/results/tier.h"
#include "narrowphase/batch/batch.h"
#include "narrowphase/pairs/pair_kinds.h"

namespace carom {

// Decides the rows that batch.unsure marks; their bodies must be valid. Writes the overlap, and
// corrects the sign of the separation if the batch has one.
void decide_unsure(const PairKind& kind, const Batch& batch, Tier tier);

// Replaces a separation with the wrong sign, or NaN from overflow, by the smallest one with the
// right sign.
float with_sign_of(uint8_t overlap, float separation);

}  // namespace carom
