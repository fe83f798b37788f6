// Tests pairs of bodies of which at least one is a mesh or a compound, through their parts.
#pragma once

#include <cstdint>
#include <span>

#include "midphase/extra_contacts.h"
#include "narrowphase/blocks/pair_block.h"

namespace carom {

// Tests the listed rows of `block`, and writes them to all result columns that are there. Pair i of
// `extra` is row i - block.first.
void run_composite_pairs(const PairBlock& block, std::span<const uint16_t> rows,
                         const ExtraRequest& extra);

}  // namespace carom
