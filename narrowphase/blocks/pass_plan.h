// Which passes a batch needs, decided in one place before any of them runs.
#pragma once

#include "carom/results/tier.h"
#include "narrowphase/pairs/pair_kinds.h"

namespace carom {

// The passes of a batch, in the order in which they run.
struct PassPlan {
  // A pair may be spared the search by the direction that separated it before, or by its
  // closest features of the last call.
  enum class Known : uint8_t { nothing, directions, features };
  // Where manifold points come from. `zero`: there are none, and the columns say so.
  enum class Points : uint8_t { none, zero, witnesses, clipped };

  Known known = Known::nothing;
  Pass search = Pass::test;        // of the pairs that are left: test, distance or clearance
  Detail search_detail;            // a search may decide alone where a later pass measures
  bool measures_in_test = false;   // the test measures separate pairs
  bool measures_separate = false;  // the distance pass runs over separate pairs afterwards
  bool measures_invalid = false;   // and writes the columns of invalid pairs, too
  bool proves = false;             // unsure rows get proofs or exact decisions
  bool bounds = false;             // separations get their error bounds
  Points points = Points::none;
  bool clears_separate = false;   // manifolds of separate pairs are written as zero
  bool single_precision = false;  // Tier::fast
};

// `has_directions`: the caller remembers directions. `batch.out` says which optional columns it
// wants.
PassPlan plan_passes(const PairKind& kind, const Batch& batch, Measured measured,
                     bool has_directions, const Accuracy& accuracy);

}  // namespace carom
