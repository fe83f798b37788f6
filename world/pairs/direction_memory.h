// Keeps the separating direction of each separate pair, which the next step tests first.
#pragma once

#include <cstdint>
#include <vector>

#include "world/pairs/carry_plan.h"

namespace carom {

class DirectionMemory {
 public:
  // Gives the pairs of `now` the directions that they had in the last step. Returns those of the
  // pairs to test, as collide_pairs() takes them.
  uint32_t* prepare(const CarryPlan& plan, const PairHistory& last, Parallelism parallelism,
                    PairHistory& now);

  // Writes the new directions of these pairs to `now`, after the tests.
  void keep(const CarryPlan& plan, Parallelism parallelism, PairHistory& now) const;

  void give_back();
  size_t bytes() const;

 private:
  template <class Use>
  void for_each_tested(const CarryPlan& plan, size_t pairs, Parallelism parallelism,
                       const Use& use) const;

  std::vector<uint32_t> tested_;
};

}  // namespace carom
