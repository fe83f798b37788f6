// The world's entry to the mid-phase and the narrow phase.
#pragma once

#include <span>

#include "carom/base/parallelism.h"
#include "carom/base/result.h"
#include "carom/results/pair.h"
#include "carom/results/result_columns.h"
#include "carom/results/tier.h"
#include "carom/shapes/views.h"
#include "narrowphase/batch/packed_direction.h"

namespace carom {

// collide() within one set, with witness points relative to the bodies. The kinds must have been
// checked when the bodies were added. For a separate pair only the decision is sure to be written.
//
// `direction`: nullptr, or one entry a pair, kNoDirection at first. The caller hands an entry in
// again with the pair's next test; a pair that is still separate in that direction takes a short
// cut. Results are the same.
void collide_pairs(const Collidables& bodies, std::span<const Pair> pairs, Detail detail,
                   const ResultColumns& out, uint32_t* direction, Parallelism parallelism,
                   const Accuracy& accuracy);

// Fails if no kernel exists for the kinds of some pair.
Result<void> check_pairs(const Collidables& a, const Collidables& b, std::span<const Pair> pairs);

// Whether the test of these kinds uses a direction.
bool uses_directions(ShapeKind a, ShapeKind b);

}  // namespace carom
