// Drops pairs of swept bounds that a step does not need.
#pragma once

#include <vector>

#include "base/block_lists.h"
#include "carom/base/parallelism.h"
#include "carom/results/pair.h"
#include "world/motion/present_bounds.h"
#include "world/motion/sweeps.h"

namespace carom {

// If one body looks ahead, all bodies are swept, since it may meet any of them. Two bodies that do
// not look ahead themselves are a pair only if their present bounds overlap.
class PairSieve {
 public:
  void run(const Sweeps& sweeps, const PresentBounds& bounds, Parallelism parallelism,
           std::vector<Pair>& pairs);

  size_t bytes() const { return lists_.bytes(); }

 private:
  BlockLists<Pair> lists_;
};

}  // namespace carom
