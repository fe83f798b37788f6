// The last filters of pairs, which need no search: excluded pairs, and a predicate of the caller.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "broadphase/sort/pair_digest.h"
#include "carom/results/pair.h"
#include "carom/results/pair_predicate.h"

namespace carom {

// It runs on the sorted list that a search has found, pairs of resting boxes included, so that the
// search keeps nothing that depends on what is excluded.
class PairSelection {
 public:
  // Drops the pairs that are in `excluded`, and then those that the predicate (nullptr: none)
  // drops. Both lists are sorted. The batches of the predicate do not depend on threads. `digest`
  // is that of the excluded pairs; nullptr: there is none, and the list is read.
  void run(std::span<const Pair> excluded, const PairDigest* digest, const PairPredicate* predicate,
           Parallelism parallelism, std::vector<Pair>& pairs);

  size_t bytes() const { return kept_.capacity() * sizeof(size_t); }

 private:
  std::vector<size_t> kept_;  // pairs that each block keeps
};

}  // namespace carom
