// Compares times of impact of sets of moving pairs with the scalar reference.
#pragma once

#include <string>

#include "cli/pairs/pair_set.h"
#include "cli/support/console.h"
#include "cli/verify/verify_outcome.h"
#include "cli/verify/verify_system.h"

namespace carom::cli {

// Finds the impacts in the order of the rows and in another order, with and without the contacts.
// Stops at the first difference. All pairs of kinds must be supported.
Result<VerifyOutcome> verify_impacts(System& system, const Engines& engines, const PairSet& pairs,
                                     const std::string& source, const Console& console);

}  // namespace carom::cli
