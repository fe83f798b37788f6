// Runs a block of pairs of any kinds and layouts: the step between the public call and the kernels.
#pragma once

#include <cstddef>

#include "carom/results/pair.h"
#include "carom/results/result_columns.h"
#include "carom/shapes/views.h"
#include "narrowphase/blocks/passes.h"

namespace carom {

struct PairBlock {
  const Collidables& a;
  const Collidables& b;
  const Pair* pairs;  // of the block; nullptr: row i is (a[first + i], b[first + i])
  size_t first;
  size_t count;   // <= kPairsPerBlock
  Detail detail;  // Detail::regions is as Detail::manifold here
  WitnessFrame frame;
  Measured measured = Measured::all;
  const float* reach = nullptr;  // contact distance of each row of the block; nullptr: 0
  PairMemory memory = {};        // by the rows of the block
  Accuracy accuracy;
  ResultColumns out;  // of the block
};

// Every pair of kinds in the block must have a kernel.
void run_pair_block(const PairBlock& block);

}  // namespace carom
