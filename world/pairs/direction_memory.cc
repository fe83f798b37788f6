#include "world/pairs/direction_memory.h"

#include "narrowphase/batch/packed_direction.h"
#include "world/store/columns.h"

namespace carom {

uint32_t* DirectionMemory::prepare(const CarryPlan& plan, const PairHistory& last,
                                   Parallelism parallelism, PairHistory& now) {
  now.direction.resize(now.pairs.size());
  for_each_block(now.pairs.size(), kPairsPerMergeBlock, parallelism,
                 [&](size_t, size_t begin, size_t end) {
                   const auto there = [&](size_t i, size_t before) {
                     const bool known = before < last.direction.size();
                     now.direction[i] = known ? last.direction[before] : kNoDirection;
                   };
                   merge_block(
                       last.pairs, now.pairs, begin, end, [](size_t) {}, there);
                 });
  tested_.resize(plan.tested());
  for_each_tested(plan, now.pairs.size(), parallelism,
                  [&](size_t i, size_t row) { tested_[row] = now.direction[i]; });
  return tested_.data();
}

void DirectionMemory::keep(const CarryPlan& plan, Parallelism parallelism, PairHistory& now) const {
  for_each_tested(plan, now.pairs.size(), parallelism,
                  [&](size_t i, size_t row) { now.direction[i] = tested_[row]; });
}

// Calls use(pair, row) for each pair that is tested.
template <class Use>
void DirectionMemory::for_each_tested(const CarryPlan& plan, size_t pairs, Parallelism parallelism,
                                      const Use& use) const {
  for_each_block(pairs, kPairsPerMergeBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    const auto open = [&](size_t first, size_t stop, size_t number) {
      for (size_t i = first; i < stop; ++i, ++number) {
        const size_t row = plan.row(number);
        if (row < plan.tested()) use(i, row);
      }
    };
    plan.for_each_stretch(begin, end, open, [](const CarriedRun&) {});
  });
}

void DirectionMemory::give_back() { give_back_scratch(tested_); }

size_t DirectionMemory::bytes() const { return bytes_of(tested_); }

}  // namespace carom
