// Tests a block of pairs that may include meshes and compounds.
#pragma once

#include "narrowphase/blocks/pair_block.h"

namespace carom {

// The contract is that of run_pair_block().
void run_mixed_block(const PairBlock& block);

}  // namespace carom
