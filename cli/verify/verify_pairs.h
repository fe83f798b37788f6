// Compares Carom's kernels with the scalar reference on sets of pairs.
#pragma once

#include <string>

#include "cli/pairs/pair_set.h"
#include "cli/support/console.h"
#include "cli/verify/verify_outcome.h"
#include "cli/verify/verify_system.h"

namespace carom::cli {

// Tests the pairs row by row and in another order, at every detail, with witness points in both
// frames. Stops at the first difference.
Result<VerifyOutcome> verify_pairs(System& system, const Engines& engines, const PairSet& pairs,
                                   const std::string& source, const Console& console);

}  // namespace carom::cli
