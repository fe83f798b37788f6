// The pairs of two steps -> those that are new, and those that are gone.
#pragma once

#include <vector>

#include "base/block_lists.h"
#include "carom/results/pair.h"
#include "world/store/body_store.h"

namespace carom {

class PairChanges {
 public:
  // Sorted, both. A pair with a body that replaced another one at its index is new; the old pair is
  // gone.
  std::vector<Pair> added, removed;

  void run(const std::vector<Pair>& last, const std::vector<Pair>& now, const BodyStore& bodies,
           Parallelism parallelism);

  // Nothing changed.
  void clear();

  // Gives memory back that lists of `pairs` pairs do not need.
  void give_back_beyond(size_t pairs);
  size_t bytes() const;

 private:
  BlockLists<Pair> added_lists_, removed_lists_;
};

}  // namespace carom
