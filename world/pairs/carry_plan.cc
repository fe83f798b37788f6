#include "world/pairs/carry_plan.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "base/parallel.h"
#include "world/store/columns.h"

namespace carom {
namespace {

// Lists the runs of a block, and returns how many of its pairs are open. is_open(pair, place in
// `last`) says so of pairs that both lists have.
template <class IsOpen>
size_t find_runs(const std::vector<Pair>& last, const std::vector<Pair>& now, size_t begin,
                 size_t end, const IsOpen& is_open, std::vector<CarriedRun>& runs) {
  const MergeRange range = matching_range(last, now, begin, end);
  size_t before = range.begin, open = 0;
  const auto is_carried = [&](size_t i, size_t old) {
    const Pair pair = now[i];
    const bool same = std::bit_cast<uint64_t>(last[old]) == std::bit_cast<uint64_t>(pair);
    return same & !is_open(pair, old);
  };
  for (size_t i = begin; i < end;) {
    while (before < range.end && pair_key(last[before]) < pair_key(now[i])) ++before;
    const size_t most = std::min(end - i, range.end - before);
    size_t length = 0;
    while (length < most && is_carried(i + length, before + length)) ++length;
    if (length > 0) {
      runs.push_back({static_cast<uint32_t>(i), static_cast<uint32_t>(i + length),
                      static_cast<uint32_t>(before)});
    }
    open += length == 0;
    before += length;
    i += std::max<size_t>(length, 1);
  }
  return open;
}

// Replaces counts by the sums of those before, and returns the sum of all.
size_t counts_to_first(std::vector<size_t>& counts) {
  size_t sum = 0;
  for (size_t& count : counts) sum += std::exchange(count, sum);
  return sum;
}

}  // namespace

void CarryPlan::test_all(size_t pairs) {
  tests_all_ = true;
  tested_ = pairs;
  dropped_ = 0;
  row_.clear();
}

void CarryPlan::match(const std::vector<Pair>& last, const std::vector<Pair>& now,
                      std::span<const uint8_t> changed, Parallelism parallelism) {
  match_if(
      last, now, [changed](Pair pair, size_t) { return changed[pair.a] | changed[pair.b]; },
      parallelism);
}

void CarryPlan::match_undue(const std::vector<Pair>& last, const std::vector<Pair>& now,
                            std::span<const uint8_t> due, Parallelism parallelism) {
  match_if(
      last, now, [due](Pair, size_t before) { return due[before]; }, parallelism);
}

template <class IsOpen>
void CarryPlan::match_if(const std::vector<Pair>& last, const std::vector<Pair>& now,
                         const IsOpen& is_open, Parallelism parallelism) {
  const size_t blocks = block_count(now.size(), kPairsPerMergeBlock);
  parallelism = unless_few(parallelism, now.size());
  runs_.reset(blocks);
  open_first_.resize(blocks);
  for_each_block(now.size(), kPairsPerMergeBlock, parallelism,
                 [&](size_t block, size_t begin, size_t end) {
                   open_first_[block] = find_runs(last, now, begin, end, is_open, runs_[block]);
                 });
  row_.clear();
  dropped_ = 0;
  tested_ = counts_to_first(open_first_);
  tests_all_ = tested_ == now.size();
  if (!tests_all_) list_open_pairs(now, parallelism);
}

void CarryPlan::list_open_pairs(const std::vector<Pair>& now, Parallelism parallelism) {
  to_test_.resize(tested_);
  for_each_block(now.size(), kPairsPerMergeBlock, parallelism,
                 [&](size_t, size_t begin, size_t end) {
                   const auto copy = [&](size_t first, size_t stop, size_t number) {
                     std::copy(now.begin() + first, now.begin() + stop, to_test_.begin() + number);
                   };
                   for_each_stretch(begin, end, copy, [](const CarriedRun&) {});
                 });
}

void CarryPlan::drop(const std::vector<uint8_t>& overlap, const std::vector<Pair>& now,
                     Parallelism parallelism) {
  const size_t blocks = block_count(now.size(), kPairsPerMergeBlock);
  if (tests_all_) {  // all are open
    runs_.reset(blocks);
    open_first_.resize(blocks);
    for (size_t block = 0; block < blocks; ++block) {
      open_first_[block] = block * kPairsPerMergeBlock;
    }
  }
  const std::vector<Pair>& open_pairs = pairs_to_test(now);
  const auto open_of = [&](size_t block) -> MergeRange {
    return {open_first_[block], block + 1 < blocks ? open_first_[block + 1] : open_pairs.size()};
  };
  row_first_.resize(blocks);
  for_each_block(blocks, 1, parallelism, [&](size_t block, size_t, size_t) {
    const MergeRange open = open_of(block);
    row_first_[block] =
        static_cast<size_t>(std::count_if(overlap.begin() + open.begin, overlap.begin() + open.end,
                                          [](uint8_t x) { return x != 0; }));
  });
  const size_t left = counts_to_first(row_first_);
  left_.resize(left);
  row_.resize(open_pairs.size());
  for_each_block(blocks, 1, parallelism, [&](size_t block, size_t, size_t) {
    const MergeRange open = open_of(block);
    size_t next = row_first_[block];
    Pair dropped;
    for (size_t number = open.begin; number < open.end; ++number) {
      // Without a branch: which pairs are dropped cannot be predicted.
      const bool stays = overlap[number] != 0;
      row_[number] = static_cast<uint32_t>(stays ? next : left);
      *(stays ? left_.data() + next : &dropped) = open_pairs[number];
      next += stays;
    }
  });
  to_test_.swap(left_);
  tests_all_ = false;
  dropped_ = tested_ - left;
  tested_ = left;
}

size_t CarryPlan::rows_before(size_t i) const {
  if (tests_all_) return i;
  const std::vector<size_t>& first = row_.empty() ? open_first_ : row_first_;
  const size_t block = i / kPairsPerMergeBlock;
  return i % kPairsPerMergeBlock == 0 && block < first.size() ? first[block] : tested_;
}

size_t CarryPlan::bytes() const {
  return runs_.bytes() + bytes_of(open_first_) + bytes_of(row_first_) + bytes_of(row_) +
         bytes_of(to_test_) + bytes_of(left_);
}

}  // namespace carom
