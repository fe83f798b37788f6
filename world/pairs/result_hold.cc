#include "world/pairs/result_hold.h"

#include <algorithm>
#include <array>

#include "base/fresh_pages.h"
#include "base/parallel.h"

namespace carom {

size_t ResultHold::find_due(const PairHistory& last, const Drift& drift, Parallelism parallelism) {
  const size_t pairs = last.pairs.size();
  due_.resize(pairs);
  due_pairs_.clear();
  if (last.holds_until.size() != pairs) {
    std::fill(due_.begin(), due_.end(), uint8_t{1});
    return pairs;
  }
  due_of_block_.reset(block_count(pairs, kPairsPerMergeBlock));
  for_each_block(pairs, kPairsPerMergeBlock, parallelism,
                 [&](size_t block, size_t begin, size_t end) {
                   // Which pairs are due cannot be predicted, so there is no branch on it.
                   std::array<uint32_t, kPairsPerMergeBlock> found;
                   size_t count = 0;
                   for (size_t i = begin; i < end; ++i) {
                     const uint32_t left = last.holds_until[i] - drift.travelled(last.pairs[i]);
                     const uint32_t is_due = left >> 31;
                     due_[i] = static_cast<uint8_t>(is_due);
                     found[count] = static_cast<uint32_t>(i);
                     count += is_due;
                   }
                   due_of_block_[block].assign(found.begin(), found.begin() + count);
                 });
  due_of_block_.concatenate(due_pairs_, parallelism);
  return due_pairs_.size();
}

void ResultHold::follow(const CarryPlan& plan, const PairHistory& now, Parallelism parallelism) {
  due_of_block_.reset(block_count(now.pairs.size(), kPairsPerMergeBlock));
  for_each_block(now.pairs.size(), kPairsPerMergeBlock, parallelism,
                 [&](size_t block, size_t begin, size_t end) {
                   std::array<uint32_t, kPairsPerMergeBlock> found;
                   size_t count = 0;
                   const auto carried = [&](const CarriedRun& run) {
                     for (uint32_t i = run.begin; i < run.end; ++i) {
                       found[count] = i;
                       count += due_[run.before + (i - run.begin)];
                     }
                   };
                   plan.for_each_stretch(
                       begin, end, [](size_t, size_t, size_t) {}, carried);
                   due_of_block_[block].assign(found.begin(), found.begin() + count);
                 });
  due_of_block_.concatenate(due_pairs_, parallelism);
}

void ResultHold::set_terms(const PairRange& range, const CarryPlan& plan,
                           const ResultBuffer& results, bool has_gaps, const Drift& drift,
                           const PairHistory& last, Parallelism parallelism,
                           PairHistory& now) const {
  resize_for_overwriting(now.holds_until, now.pairs.size());
  const auto set = [&](size_t begin, size_t end, size_t number) {
    for (size_t i = begin; i < end; ++i, ++number) {
      const size_t row = plan.row(number);
      const float gap = has_gaps && row < plan.tested() ? results.gap(row) : 0;
      now.holds_until[i] = drift.holds_until(now.pairs[i], gap);
    }
  };
  const auto copy = [&](const CarriedRun& run) {
    std::copy_n(last.holds_until.begin() + run.before, run.end - run.begin,
                now.holds_until.begin() + run.begin);
  };
  for_each_block(range.end - range.begin, kPairsPerMergeBlock, parallelism,
                 [&](size_t, size_t begin, size_t end) {
                   plan.for_each_stretch(range.begin + begin, range.begin + end, set, copy);
                 });
}

}  // namespace carom
