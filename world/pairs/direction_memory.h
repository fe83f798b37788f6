// Keeps the separating directions of separate pairs of kinds that have a direction pass, which the
// next step tests first. Where the pairs with a direction are few beside those to test, looking for
// them takes longer than it saves: then it keeps none for a while.
#pragma once

#include <cstdint>
#include <vector>

#include "world/pairs/carry_plan.h"
#include "world/pairs/pauses.h"

namespace carom {

class DirectionMemory {
 public:
  // Call it once a step. Whether the step is to use directions.
  bool starts_step();

  // Gives the pairs of `now` the directions that they had in the last step. Returns those of the
  // pairs to test, as collide_pairs() takes them.
  uint32_t* prepare(const CarryPlan& plan, const PairHistory& last, Parallelism parallelism,
                    PairHistory& now);

  // Writes the new directions of these pairs to `now`, after the tests. Other pairs lose their
  // shells, since a place of a shell is good for one step.
  void keep(const CarryPlan& plan, Parallelism parallelism, PairHistory& now) const;

  void give_back();
  size_t bytes() const;

 private:
  template <class Tested, class Other>
  void for_each(const CarryPlan& plan, size_t pairs, Parallelism parallelism, const Tested& tested,
                const Other& other) const;

  // Begins a pause if the pairs with a known direction are few beside those to test.
  void judge(size_t known, size_t tested);

  std::vector<uint32_t> tested_;
  Pauses pauses_{4, 64};
};

}  // namespace carom
