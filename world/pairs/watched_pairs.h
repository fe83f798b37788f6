// Finds the pairs that are due, and watches those that soon may be. In a crowd that creeps most
// pairs are separate, and far from due.
//
// Every now and then all pairs are looked at, and those are listed that would be due if each
// odometer gained so much more. Until one has, no other pair is due.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/block_lists.h"
#include "carom/base/parallelism.h"
#include "world/pairs/pair_history.h"

namespace carom {

class WatchedPairs {
 public:
  // There are other pairs, or pairs that were not due have other limits.
  void forget() { is_known_ = false; }

  // Replaces `due` by the indices of the pairs that are due, ascending. Call it once a step.
  // `odometers`: one a body, of which none has gained more than `gained` since the last call.
  void find_due(const PairHistory& last, std::span<const uint32_t> odometers, uint32_t gained,
                Parallelism parallelism, std::vector<uint32_t>& due);

  // Whether the list is shorter than that of all pairs; if not, all are looked at.
  bool is_short() const { return is_short_; }

  void give_back();
  size_t bytes() const;

 private:
  void list(const PairHistory& last, std::span<const uint32_t> odometers, uint32_t gained,
            Parallelism parallelism);

  bool is_known_ = false, is_short_ = false;
  uint32_t left_ = 0;  // ticks that each odometer may still gain before the next list
  std::vector<uint32_t> number_;
  std::vector<Pair> pairs_;
  BlockLists<uint32_t> of_block_;
};

}  // namespace carom
