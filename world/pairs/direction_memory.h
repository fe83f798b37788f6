// Keeps the separating direction of each separate pair, which the next step tests first.
#pragma once

#include <cstdint>
#include <vector>

#include "world/pairs/pair_history.h"

namespace carom {

class DirectionMemory {
 public:
  // One direction for each pair to test, as collide_pairs() takes them. `plan` matches `now` with
  // `last`.
  uint32_t* prepare(const CarryPlan& plan, const PairHistory& last, const PairHistory& now,
                    Parallelism parallelism);

  // Writes the directions of all pairs to `now`, after the tests.
  void keep(const CarryPlan& plan, const PairHistory& last, Parallelism parallelism,
            PairHistory& now) const;

  void give_back();
  size_t bytes() const;

 private:
  std::vector<uint32_t> tested_;
};

}  // namespace carom
