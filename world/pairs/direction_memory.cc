#include "world/pairs/direction_memory.h"

#include <algorithm>
#include <atomic>

#include "base/fresh_pages.h"
#include "narrowphase/batch/packed_direction.h"
#include "world/store/columns.h"

namespace carom {
namespace {

// Most pairs lie in runs that both steps have. So many of them are compared at once.
constexpr size_t kRun = 8;

// Whether the next kRun pairs of both steps are the same.
bool are_same(const Pair* last, const Pair* now) {
  uint64_t difference = 0;
  for (size_t k = 0; k < kRun; ++k) difference |= pair_key(last[k]) ^ pair_key(now[k]);
  return difference == 0;
}

// Whether the pair has a direction, or a shell in its place.
bool is_known(uint32_t word) { return is_direction(word) || (word & kHasShell) != 0; }

// Gives pairs [begin, end) of `now` their words of the last step, and returns how many are known.
// Which pairs there are between two runs cannot be predicted, so there is no branch on it.
size_t match_directions(const PairHistory& last, PairHistory& now, size_t begin, size_t end) {
  static_assert(kNoDirection == 0);
  const MergeRange range = matching_range(last.pairs, now.pairs, begin, end);
  size_t before = range.begin, i = begin, known = 0;
  const auto give = [&](uint32_t word) {
    now.direction[i] = word;
    known += is_known(word);
  };
  while (before < range.end && i < end) {
    while (before + kRun <= range.end && i + kRun <= end &&
           are_same(&last.pairs[before], &now.pairs[i])) {
      for (size_t k = 0; k < kRun; ++k, ++i, ++before) give(last.direction[before]);
    }
    for (size_t k = 0; k < kRun && before < range.end && i < end; ++k) {
      const uint64_t key_before = pair_key(last.pairs[before]), key = pair_key(now.pairs[i]);
      give(last.direction[before] & (key_before == key ? 0xffffffffu : 0u));
      before += key_before <= key;
      i += key <= key_before;
    }
  }
  std::fill(now.direction.begin() + static_cast<ptrdiff_t>(i),
            now.direction.begin() + static_cast<ptrdiff_t>(end), kNoDirection);
  return known;
}

}  // namespace

bool DirectionMemory::starts_step() { return pauses_.starts_step(); }

void DirectionMemory::judge(size_t known, size_t tested) {
  constexpr size_t kFewest = 4;  // fewer than one in so many are few
  if (kFewest * known >= tested) {
    pauses_.end();
  } else {
    pauses_.begin();
  }
}

uint32_t* DirectionMemory::prepare(const CarryPlan& plan, const PairHistory& last,
                                   Parallelism parallelism, PairHistory& now) {
  resize_for_overwriting(now.direction, now.pairs.size());
  if (last.direction.empty()) {
    std::fill(now.direction.begin(), now.direction.end(), kNoDirection);
  } else {
    std::atomic<size_t> known{0};
    for_each_block(now.pairs.size(), kPairsPerMergeBlock, parallelism,
                   [&](size_t, size_t begin, size_t end) {
                     known += match_directions(last, now, begin, end);
                   });
    judge(known, plan.tested());
  }
  resize_for_overwriting(tested_, plan.tested());
  for_each(
      plan, now.pairs.size(), parallelism,
      [&](size_t i, size_t row) { tested_[row] = now.direction[i]; }, [](size_t) {});
  return tested_.data();
}

void DirectionMemory::keep(const CarryPlan& plan, Parallelism parallelism, PairHistory& now) const {
  for_each(
      plan, now.pairs.size(), parallelism,
      [&](size_t i, size_t row) { now.direction[i] = tested_[row]; },
      [&](size_t i) {
        if (!is_direction(now.direction[i])) now.direction[i] = kNoDirection;
      });
}

// Calls tested(pair, row) for each pair that is tested, and other(pair) for all others.
template <class Tested, class Other>
void DirectionMemory::for_each(const CarryPlan& plan, size_t pairs, Parallelism parallelism,
                               const Tested& tested, const Other& other) const {
  for_each_block(pairs, kPairsPerMergeBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    const auto open = [&](size_t first, size_t stop, size_t number) {
      for (size_t i = first; i < stop; ++i, ++number) {
        const size_t row = plan.row(number);
        row < plan.tested() ? tested(i, row) : other(i);
      }
    };
    plan.for_each_stretch(begin, end, open, [&](const CarriedRun& run) {
      for (size_t i = run.begin; i < run.end; ++i) other(i);
    });
  });
}

void DirectionMemory::give_back() { give_back_scratch(tested_); }

size_t DirectionMemory::bytes() const { return bytes_of(tested_); }

}  // namespace carom
