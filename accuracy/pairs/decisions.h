// Decisions by the million: those of the certified and exact tiers against proofs, one pair at a
// time.
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
  size_t undecided = 0;  // certified
  size_t wrong_certified = 0;
  size_t wrong_exact = 0;  // undecided ones included
  std::string failure;     // the first wrong one, with all numbers of the pair; or empty

  bool is_sound() const { return wrong_certified == 0 && wrong_exact == 0; }
};

// Of these kinds, at least `count` pairs: a third at random, a third moved to touch to within 64
// roundings, a third to within four; two in five nearly parallel. Positions are float32. The judge
// is narrowphase/proof/proof.h, and exact arithmetic where that proves nothing; both are held
// against the oracle by tests/narrowphase/proof/exact_overlap_test.cc.
DecisionCount count_decisions(const KindPair& kinds, size_t count, uint64_t seed,
                              const std::function<void(size_t done)>& progress);

}  // namespace carom::accuracy
