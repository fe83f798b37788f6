// A block of pairs among which there may be meshes and compounds.
#pragma once

#include "narrowphase/blocks/pair_block.h"

namespace carom {

// As run_pair_block().
void run_mixed_block(const PairBlock& block);

}  // namespace carom
