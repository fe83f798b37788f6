// Runs contenders on a set of pairs and holds every answer against the exact one.
#pragma once

#include <span>
#include <vector>

#include "accuracy/tiers/contenders.h"
#include "accuracy/tiers/tally.h"

namespace carom::accuracy {

struct Attempt {
  Contender* contender;
  Detail detail = Detail::contact;
  bool flush_to_zero = false;  // the mode that the caller has set
};

// What is promised, in shares of L + gap: of separations, and of the penetration along the normal
// against the least.
inline constexpr double kSeparationBound = 2e-6;
inline constexpr double kNormalBound = 1e-5;
// Decisions of the standard tier are right unless the gap is smaller.
inline constexpr double kDecisionBound = 4 * 0x1p-23;

// One tally a attempt. Exact answers are computed once for all of them.
std::vector<Tally> judge(const PairSet& pairs, std::span<const Attempt> attempts);

}  // namespace carom::accuracy
