// Tests a block of pairs that may include meshes and compounds.
#pragma once

#include "midphase/extra_contacts.h"
#include "narrowphase/blocks/pair_block.h"

namespace carom {

// The contract is that of run_pair_block(). Pair i of `extra` is row i - block.first.
void run_mixed_block(const PairBlock& block, const ExtraRequest& extra);

}  // namespace carom
