// The world's way into the mid-phase and the narrow phase.
#pragma once

#include <span>

#include "carom/base/parallelism.h"
#include "carom/base/result.h"
#include "carom/results/contact.h"
#include "carom/results/pair.h"
#include "carom/results/tier.h"
#include "carom/shapes/views.h"
#include "narrowphase/batch/packed_direction.h"

namespace carom {

// collide() within one set, with witness points relative to the bodies. The kinds were checked when
// the bodies were added. Of separate pairs the decision alone is sure to be written. `direction`:
// nullptr, or one a pair, kNoDirection at first, to be handed in again with the pair's next test:
// pairs that are still apart in that direction take a short cut. Results are the same.
void collide_pairs(const Collidables& bodies, std::span<const Pair> pairs, Detail detail,
                   const ResultColumns& out, uint32_t* direction, Parallelism parallelism,
                   const Accuracy& accuracy);

// Fails if a pair is of kinds that no kernel exists for.
Result<void> check_pairs(const Collidables& a, const Collidables& b, std::span<const Pair> pairs);

// Whether tests of these kinds make use of directions.
bool uses_directions(ShapeKind a, ShapeKind b);

}  // namespace carom
