// Runs contenders on a set of pairs and compares every answer with the exact one.
#pragma once

#include <span>
#include <vector>

#include "accuracy/tiers/contenders.h"
#include "accuracy/tiers/tally.h"

namespace carom::accuracy {

struct Attempt {
  Contender* contender;
  Detail detail = Detail::contact;
  bool flush_to_zero = false;  // whether the caller sets this mode
};

// The promised bounds, as shares of L + gap: the error of separations, and the excess of the
// penetration along the normal over the least.
inline constexpr double kSeparationBound = 2e-6;
inline constexpr double kNormalBound = 1e-5;
// Decisions of the standard tier are right unless |gap| is smaller than this share.
inline constexpr double kDecisionBound = 4 * 0x1p-23;

// Returns one tally for each attempt. Exact answers are computed once for all attempts.
std::vector<Tally> judge(const PairSet& pairs, std::span<const Attempt> attempts);

}  // namespace carom::accuracy
