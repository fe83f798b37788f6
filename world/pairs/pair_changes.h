// The pairs of two steps -> the pairs that appeared and those that vanished.
#pragma once

#include <vector>

#include "base/block_lists.h"
#include "carom/results/pair.h"
#include "world/store/body_store.h"

namespace carom {

class PairChanges {
 public:
  // Both sorted. If a body has replaced another one at its index, its pairs count as removed and
  // added.
  std::vector<Pair> added, removed;

  void run(const std::vector<Pair>& last, const std::vector<Pair>& now, const BodyStore& bodies,
           Parallelism parallelism);

  // For a step without changes.
  void clear();

  void give_back();
  size_t bytes() const;

 private:
  BlockLists<Pair> added_lists_, removed_lists_;
};

}  // namespace carom
