// Checks millions of decisions of the certified and exact tiers against a proof for each pair.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "accuracy/pairs/oracle_pairs.h"

namespace carom::accuracy {

struct DecisionCount {
  size_t pairs = 0;
  size_t overlapping = 0;
  size_t undecided = 0;  // by the certified tier
  size_t wrong_certified = 0;
  size_t wrong_exact = 0;  // undecided ones included
  std::string failure;     // the first wrong pair with all its numbers; or empty

  bool is_sound() const { return wrong_certified == 0 && wrong_exact == 0; }
};

// Checks at least `count` pairs of these kinds: a third random, a third moved to touch within 64
// roundings, a third within four. Two in five are nearly parallel. Positions are float32.
// narrowphase/proof/proof.h gives the true decision, or exact arithmetic if it proves nothing;
// tests/narrowphase/proof/exact_overlap_test.cc checks both against the oracle.
DecisionCount count_decisions(const KindPair& kinds, size_t count, uint64_t seed,
                              const std::function<void(size_t done)>& progress);

}  // namespace carom::accuracy
