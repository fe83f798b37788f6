#include "world/pairs/result_hold.h"

#include <algorithm>

#include "base/fresh_pages.h"
#include "base/parallel.h"

namespace carom {

size_t ResultHold::find_due(const PairHistory& last, const Drift& drift, Parallelism parallelism) {
  const size_t pairs = last.pairs.size();
  due_pairs_.clear();
  knows_last_ = last.holds_until.size() == pairs;
  if (!knows_last_) return pairs;
  watched_.find_due(last, drift.odometers(), drift.most_gained(), parallelism, due_pairs_);
  return due_pairs_.size();
}

std::span<const uint8_t> ResultHold::due_flags(size_t pairs) {
  due_.assign(pairs, knows_last_ ? 0 : 1);
  for (const uint32_t i : due_pairs_) due_[i] = 1;
  return due_;
}

void ResultHold::follow(const CarryPlan& plan, size_t pairs) {
  size_t next = 0, kept = 0;
  for_each_merge_block(pairs, Parallelism::none, [&](size_t, size_t begin, size_t end) {
    const auto carried = [&](const CarriedRun& run) {
      const uint32_t end_before = run.before + (run.end - run.begin);
      while (next < due_pairs_.size() && due_pairs_[next] < run.before) ++next;
      for (; next < due_pairs_.size() && due_pairs_[next] < end_before; ++next) {
        due_pairs_[kept++] = due_pairs_[next] - run.before + run.begin;
      }
    };
    plan.for_each_stretch(
        begin, end, [](size_t, size_t, size_t) {}, carried);
  });
  due_pairs_.resize(kept);
}

void ResultHold::set_terms(const PairRange& range, const CarryPlan& plan, const GapStage& gaps,
                           const Drift& drift, const PairHistory& last, Parallelism parallelism,
                           PairHistory& now) {
  watched_.forget();
  resize_for_overwriting(now.holds_until, now.pairs.size());
  const auto set = [&](size_t begin, size_t end, size_t number) {
    for (size_t i = begin; i < end; ++i, ++number) {
      const size_t row = plan.row(number);
      const float gap = row < plan.tested() ? gaps.gap(row) : 0;
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
