// Pairs of bodies of which one is a mesh or a compound at least: through their parts.
#pragma once

#include <cstdint>
#include <span>

#include "narrowphase/blocks/pair_block.h"

namespace carom {

// Tests the rows of `block` that are listed, and writes them, all of the columns that are there.
void run_composite_pairs(const PairBlock& block, std::span<const uint16_t> rows);

}  // namespace carom
