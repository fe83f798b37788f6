// Which pairs of a step are tested, and which keep their result of the last step. Where few bodies
// move, nearly all pairs keep it, and most are neighbours in both lists: stages take them by runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/block_lists.h"
#include "carom/base/parallelism.h"
#include "carom/results/pair.h"
#include "world/pairs/pair_history.h"

namespace carom {

// Pairs that are neighbours in this step and in the last one: [begin, end) of this step are those
// from `before` on of the last.
struct CarriedRun {
  uint32_t begin, end;
  uint32_t before;
};

// Pairs that are not carried are open. They have numbers, in their order.
class CarryPlan {
 public:
  // Tests all pairs.
  void test_all(size_t pairs);

  // Tests nothing: the step repeats the last one.
  void carry_all() { tested_ = dropped_ = 0; }

  // Carries the pairs that `last` has, too, if neither body changed. `changed`: one byte an index.
  void match(const std::vector<Pair>& last, const std::vector<Pair>& now,
             std::span<const uint8_t> changed, Parallelism parallelism);

  // Carries those whose byte in `due` (one a pair of `last`) is zero.
  void match_undue(const std::vector<Pair>& last, const std::vector<Pair>& now,
                   std::span<const uint8_t> due, Parallelism parallelism);

  // Drops the open pairs whose byte is zero: they do not overlap.
  void drop(const std::vector<uint8_t>& overlap, const std::vector<Pair>& now,
            Parallelism parallelism);

  bool tests_all() const { return tests_all_; }
  size_t tested() const { return tested_; }
  size_t dropped() const { return dropped_; }

  // The pairs to test: all of `now`, or a separate list.
  const std::vector<Pair>& pairs_to_test(const std::vector<Pair>& now) const {
    return tests_all_ ? now : to_test_;
  }

  // The row of an open pair among the pairs to test; the row after the last one for a dropped pair.
  size_t row(size_t number) const { return row_.empty() ? number : row_[number]; }

  // How many of the pairs before pair i are tested: the row of the first one from i on. `i` must be
  // a multiple of kPairsPerMergeBlock, or the number of pairs.
  size_t rows_before(size_t i) const;

  // Calls for the pairs of a merge block, or of its first ones, in their order:
  //   open(begin, end, number)     neighbours that are not carried, and the number of the first
  //   carried(run)                 neighbours that are
  template <class Open, class Carried>
  void for_each_stretch(size_t begin, size_t end, const Open& open, const Carried& carried) const {
    if (tests_all_) return open(begin, end, begin);
    const size_t block = begin / kPairsPerMergeBlock;
    size_t number = begin < end ? open_first_[block] : 0;
    const auto open_until = [&](size_t stop) {
      if (begin < stop) open(begin, stop, number);
      number += stop - begin;
    };
    for (const CarriedRun& run : runs_of(block)) {
      open_until(run.begin);
      carried(run);
      begin = run.end;
    }
    open_until(end);
  }

  // The carried pairs of a merge block.
  std::span<const CarriedRun> runs_of(size_t block) const {
    return block < runs_.blocks() ? runs_[block] : std::span<const CarriedRun>();
  }

  size_t bytes() const;

 private:
  template <class IsOpen>
  void match_if(const std::vector<Pair>& last, const std::vector<Pair>& now, const IsOpen& is_open,
                Parallelism parallelism);
  void list_open_pairs(const std::vector<Pair>& now, Parallelism parallelism);

  bool tests_all_ = true;
  size_t tested_ = 0;
  size_t dropped_ = 0;
  BlockLists<CarriedRun> runs_;       // a list a merge block
  std::vector<size_t> open_first_;    // the number of the first open pair of each block
  std::vector<size_t> row_first_;     // its row, if pairs were dropped
  std::vector<uint32_t> row_;         // of each open pair; empty if none was dropped
  std::vector<Pair> to_test_, left_;  // left_: the pairs that drop() leaves
};

}  // namespace carom
