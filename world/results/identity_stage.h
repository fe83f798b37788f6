// The contacts of two steps -> which ones continue.
#pragma once

#include "world/pairs/pair_history.h"
#include "world/store/body_store.h"

namespace carom {

// Fills the previous contacts and points of `now.identities`, whose names are there.
void find_previous(const PairHistory& last, const BodyStore& bodies, Parallelism parallelism,
                   PairHistory& now);

// The same for a step that repeats the last one: every contact continues itself.
void repeat_identities(Parallelism parallelism, PairHistory& now);

}  // namespace carom
