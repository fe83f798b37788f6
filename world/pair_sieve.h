// Of the pairs of bounds over an interval, those that a step asks for.
#pragma once

#include <vector>

#include "carom/kernel/pair.h"
#include "carom/kernel/parallelism.h"
#include "kernel/block_lists.h"
#include "world/present_bounds.h"
#include "world/sweeps.h"

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
