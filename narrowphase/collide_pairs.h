// The world's way into the narrow phase.
#pragma once

#include <span>

#include "carom/kernel/contact.h"
#include "carom/kernel/pair.h"
#include "carom/kernel/parallelism.h"
#include "carom/kernel/views.h"

namespace carom {

// collide() within one set, with witness points relative to the bodies. The kinds were checked when
// the bodies were added. Of separate pairs the decision alone is sure to be written.
void collide_pairs(const Collidables& bodies, std::span<const Pair> pairs, Detail detail,
                   const ResultColumns& out, Parallelism parallelism);

}  // namespace carom
