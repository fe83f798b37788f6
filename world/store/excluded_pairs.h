// The pairs that callers exclude: a sorted list, and the changes since the last step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/sort/pair_digest.h"
#include "carom/results/pair.h"
#include "world/store/columns.h"

namespace carom {

class ExcludedPairs {
 public:
  // These note a change of the pair, a != b, in any order.
  void exclude(Pair pair);
  void include_again(Pair pair);
  // Forgets the pairs of a body, since another may take its index.
  void remove_body(uint32_t index);

  bool has_changes() const { return !changes_.empty(); }
  // With all changes so far.
  bool contains(Pair pair) const;

  // Makes the changes. A list of any length costs one pass.
  void update();
  // Sorted by (a, b), a < b; as of the last update.
  std::span<const Pair> pairs() const { return pairs_; }
  const PairDigest& digest() const { return digest_; }

  void give_back() { carom::give_back(pairs_, changes_, is_used_); }
  size_t bytes() const {
    return bytes_of(pairs_) + digest_.bytes() + bytes_of(changes_) + bytes_of(is_used_);
  }

 private:
  enum class Kind : uint8_t { exclude, include, remove };
  struct Change {
    Pair pair;  // the body twice for `remove`
    Kind kind;
  };

  void drop_removed();
  void merge();

  std::vector<Pair> pairs_;
  PairDigest digest_;
  std::vector<Change> changes_;   // in the order of the calls
  std::vector<uint8_t> is_used_;  // by body: 0 if it has no excluded pair
};

}  // namespace carom
