// Sets of moving pairs: times of impact against the scalar reference.
#pragma once

#include <string>

#include "cli/pairs/pair_set.h"
#include "cli/support/console.h"
#include "cli/verify/verify_outcome.h"
#include "cli/verify/verify_system.h"

namespace carom::cli {

// Looks for the impacts in the order of the rows and in another one, with and without the contacts,
// and stops at the first difference. Kinds have to be such that meet.
Result<VerifyOutcome> verify_impacts(System& system, const Engines& engines, const PairSet& pairs,
                                     const std::string& source, const Console& console);

}  // namespace carom::cli
