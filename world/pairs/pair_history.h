// The pairs of one step with their results, and what becomes of them in the next step.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "base/raw_vector.h"
#include "carom/results/contact_identity.h"
#include "carom/results/pair.h"

namespace carom {

inline constexpr size_t kPairsPerMergeBlock = 4096;

// Every list has one entry a candidate pair, sorted by (a, b), except the contacts and manifolds.
struct PairHistory {
  // Values of `contact` that are no index.
  static constexpr uint32_t kNone = 0xffffffffu;
  // overlap without a contact, because a body is a sensor
  static constexpr uint32_t kSensor = 0xfffffffeu;

  std::vector<Pair> pairs;
  RawVector<uint8_t> overlaps;
  RawVector<uint32_t> contact;        // index into `contacts`
  std::vector<uint32_t> direction;    // DirectionMemory's; empty if unused
  std::vector<uint32_t> holds_until;  // ResultHold's; empty if unused
  RawVector<Contact> contacts;
  RawVector<ManifoldPoints> manifolds;  // one a contact at details with manifolds, else none

  LargeVector<ContactIdentity> identities;  // one a contact, if they are wanted

  // Whether a value of `contact` is an index.
  static bool is_place(uint32_t contact) { return contact < kSensor; }
  bool has_contact(size_t i) const { return is_place(contact[i]); }

  void clear();
  void clear_contacts();  // and what belongs to them
  void give_back();
  size_t bytes() const;
};

// The part of `last` that belongs to block [begin, end) of `now`. All blocks of `now` together
// cover all of `last`.
struct MergeRange {
  size_t begin;
  size_t end;
};
MergeRange matching_range(const std::vector<Pair>& last, const std::vector<Pair>& now, size_t begin,
                          size_t end);

// The number of blocks of `pairs` pairs; at least one, which takes the pairs of the last step.
inline size_t merge_block_count(size_t pairs) {
  return std::max<size_t>(1, block_count(pairs, kPairsPerMergeBlock));
}

// Calls body(block, begin, end) for each of them.
template <class Body>
void for_each_merge_block(size_t pairs, Parallelism parallelism, const Body& body) {
  if (pairs == 0) body(0, 0, 0);
  for_each_block(pairs, kPairsPerMergeBlock, parallelism, body);
}

inline constexpr size_t kNotThere = ~size_t{0};

// Merges block [begin, end) of `now` with its part of `last`, and calls in order:
//   gone(index into last)                     for pairs that `now` lacks
//   there(index into now, index into last)    for all others; kNotThere if `last` lacks the pair
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

}  // namespace carom
