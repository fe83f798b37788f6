#include "world/pairs/direction_memory.h"

#include "narrowphase/batch/packed_direction.h"
#include "world/store/columns.h"

namespace carom {
namespace {

// The direction of pair i of `now`, if the last step had the pair.
uint32_t last_direction(const CarryPlan& plan, const PairHistory& last, const PairHistory& now,
                        size_t i) {
  const uint32_t index = plan.last_index(i);
  const bool known = index < last.direction.size() && last.pairs[index] == now.pairs[i];
  return known ? last.direction[index] : kNoDirection;
}

}  // namespace

uint32_t* DirectionMemory::prepare(const CarryPlan& plan, const PairHistory& last,
                                   const PairHistory& now, Parallelism parallelism) {
  tested_.resize(plan.tested());
  for_each_block(now.pairs.size(), kPairsPerMergeBlock, parallelism,
                 [&](size_t, size_t begin, size_t end) {
                   for (size_t i = begin; i < end; ++i) {
                     if (!plan.tests(i)) continue;
                     tested_[plan.test_row(i)] = last_direction(plan, last, now, i);
                   }
                 });
  return tested_.data();
}

void DirectionMemory::keep(const CarryPlan& plan, const PairHistory& last, Parallelism parallelism,
                           PairHistory& now) const {
  now.direction.resize(now.pairs.size());
  for_each_block(
      now.pairs.size(), kPairsPerMergeBlock, parallelism, [&](size_t, size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
          now.direction[i] =
              plan.tests(i) ? tested_[plan.test_row(i)] : last_direction(plan, last, now, i);
        }
      });
}

void DirectionMemory::give_back() { give_back_scratch(tested_); }

size_t DirectionMemory::bytes() const { return bytes_of(tested_); }

}  // namespace carom
