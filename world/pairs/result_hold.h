// Which results of the last step still hold within the tolerance, by the odometers of the bodies.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "world/changes/drift.h"
#include "world/pairs/carry_plan.h"
#include "world/pairs/gap_stage.h"
#include "world/pairs/pair_history.h"
#include "world/pairs/pauses.h"
#include "world/pairs/watched_pairs.h"
#include "world/store/columns.h"

namespace carom {

class ResultHold {
 public:
  // Finds the pairs of the last step whose result no longer holds, and returns their number: all
  // if that step has set no terms.
  size_t find_due(const PairHistory& last, const Drift& drift, Parallelism parallelism);
  // Their indices, ascending.
  std::span<const uint32_t> due_pairs() const { return due_pairs_; }
  // The same as one byte a pair of the last step, which had so many.
  std::span<const uint8_t> due_flags(size_t pairs);
  // Makes them indices of this step's pairs, which are so many; of those that are carried.
  void follow(const CarryPlan& plan, size_t pairs);

  // Sets until when the results of a range hold that have been tested, whose gaps are known, and
  // copies it of those that are carried.
  void set_terms(const PairRange& range, const CarryPlan& plan, const GapStage& gaps,
                 const Drift& drift, const PairHistory& last, Parallelism parallelism,
                 PairHistory& now);

  void give_back() {
    give_back_scratch(due_, due_pairs_);
    watched_.give_back();
  }
  size_t bytes() const { return bytes_of(due_) + bytes_of(due_pairs_) + watched_.bytes(); }

 private:
  bool knows_last_ = false;
  std::vector<uint8_t> due_;
  std::vector<uint32_t> due_pairs_;
  WatchedPairs watched_;
};

// Takes long pauses from keeping results where few of them hold, since it then costs more than it
// saves.
class HoldWatch {
 public:
  // Call it once a step. Whether it keeps results.
  bool starts_step() { return pauses_.starts_step(); }

  // Nothing would hold.
  void pause() { pauses_.begin(); }

  // After a step, with the numbers of its pairs that it kept, and of all.
  void saw(size_t kept, size_t pairs, bool had_terms) {
    constexpr size_t kFewest = 4;  // fewer than one pair in so many are few
    constexpr size_t kCheap = 64;  // so few pairs cost nothing
    if (kFewest * kept >= pairs || pairs < kCheap) {
      pauses_.end();
    } else if (had_terms) {
      pause();
    }
  }

 private:
  Pauses pauses_{8, 128};
};

}  // namespace carom
