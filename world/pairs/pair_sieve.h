// Of the pairs of bounds over an interval, those that a step asks for.
#pragma once

#include <vector>

#include "base/block_lists.h"
#include "carom/base/parallelism.h"
#include "carom/results/pair.h"
#include "world/motion/present_bounds.h"
#include "world/motion/sweeps.h"

namespace carom {

// All bodies are swept where one looks ahead, since each may be met on its way. Two that do not
// look ahead themselves are a pair only if their bounds meet now.
class PairSieve {
 public:
  void run(const Sweeps& sweeps, const PresentBounds& bounds, Parallelism parallelism,
           std::vector<Pair>& pairs);

  void give_back_beyond(size_t pairs);
  size_t bytes() const { return lists_.bytes(); }

 private:
  BlockLists<Pair> lists_;
};

}  // namespace carom
