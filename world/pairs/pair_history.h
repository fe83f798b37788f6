// The pairs of one step with their outcome, and how the next step's pairs relate to them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "carom/results/contact.h"
#include "carom/results/pair.h"

namespace carom {

inline constexpr size_t kPairsPerMergeBlock = 4096;

// One entry a candidate pair in every list, sorted by (a, b).
struct PairHistory {
  // Values of `contact` that are no index.
  static constexpr uint32_t kNone = 0xffffffffu;
  static constexpr uint32_t kSensor = 0xfffffffeu;  // overlap without contact: a sensor's

  std::vector<Pair> pairs;
  std::vector<uint8_t> overlaps;
  std::vector<uint32_t> contact;    // index into `contacts`
  std::vector<uint32_t> direction;  // DirectionMemory's; empty where nothing uses it
  std::vector<Contact> contacts;
  std::vector<ManifoldPoints> manifolds;  // at Detail::manifold one a contact, else none

  void clear();
  void give_back_beyond(size_t pairs);
  size_t bytes() const;
};

// The part of `last` that belongs to block [begin, end) of `now`: blocks of `now` together cover
// all of `last`.
struct MergeRange {
  size_t begin;
  size_t end;
};
MergeRange matching_range(const std::vector<Pair>& last, const std::vector<Pair>& now, size_t begin,
                          size_t end);

// Blocks of `pairs` pairs, one at least: it takes what the last step had.
inline size_t merge_block_count(size_t pairs) {
  return std::max<size_t>(1, block_count(pairs, kPairsPerMergeBlock));
}

// body(block, begin, end) for each of them.
template <class Body>
void for_each_merge_block(size_t pairs, Parallelism parallelism, const Body& body) {
  if (pairs == 0) body(0, 0, 0);
  for_each_block(pairs, kPairsPerMergeBlock, parallelism, body);
}

inline constexpr size_t kNotThere = ~size_t{0};

// Goes through block [begin, end) of `now` and what belongs to it of `last`, in order:
//   gone(index into last)                     pairs that `now` lacks
//   there(index into now, index into last)    the others; kNotThere where `last` lacks them
template <class Gone, class There>
void merge_block(const std::vector<Pair>& last, const std::vector<Pair>& now, size_t begin,
                 size_t end, const Gone& gone, const There& there) {
  const MergeRange range = matching_range(last, now, begin, end);
  size_t before = range.begin;
  for (size_t i = begin; i < end; ++i) {
    for (; before < range.end && last[before] < now[i]; ++before) gone(before);
    const bool known = before < range.end && last[before] == now[i];
    there(i, known ? before : kNotThere);
    before += known;
  }
  for (; before < range.end; ++before) gone(before);
}

// What is tested and what is carried over from the last step.
class CarryPlan {
 public:
  static constexpr uint32_t kCarried = 0xffffffffu;

  // Everything is tested.
  void test_all(size_t pairs);

  // Nothing is: the step repeats the last one.
  void carry_all() { tested_ = dropped_ = 0; }

  // Carries the pairs that `last` holds, too, and of which neither body changed: one byte an index.
  void match(const PairHistory& last, const std::vector<Pair>& now,
             std::span<const uint8_t> changed, Parallelism parallelism);

  // Of the pairs to test leaves those whose byte is not zero; the others do not overlap.
  void drop(const std::vector<uint8_t>& overlap, const std::vector<Pair>& now,
            Parallelism parallelism);

  size_t tested() const { return tested_; }
  size_t dropped() const { return dropped_; }

  // The pairs to test: all of `now`, or a list of its own.
  const std::vector<Pair>& pairs_to_test(const std::vector<Pair>& now) const {
    return tests_all_ ? now : to_test_;
  }

  // Row of pair i among those, or kCarried; of a dropped one the row behind the last.
  uint32_t test_row(size_t i) const { return tests_all_ ? static_cast<uint32_t>(i) : row_[i]; }
  bool tests(size_t i) const { return test_row(i) < tested_; }

  // Index of a carried pair in the last step.
  uint32_t last_index(size_t i) const { return last_[i]; }

  void give_back_beyond(size_t pairs);
  size_t bytes() const;

 private:
  bool tests_all_ = true;
  size_t tested_ = 0;
  size_t dropped_ = 0;
  std::vector<uint32_t> row_;
  std::vector<uint32_t> last_;
  std::vector<Pair> to_test_;
  std::vector<Pair> left_;  // of those, while others are dropped
  std::vector<size_t> block_first_;
};

}  // namespace carom
