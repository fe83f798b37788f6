// The contacts of pairs at their times of impact.
#pragma once

#include <cstdint>

#include "carom/impacts/time_of_impact.h"
#include "impacts/impact.h"
#include "impacts/simple_times.h"

namespace carom {

// Fills the contact columns of `out` for all rows: with NaN if the row has no time in [0, 1]. The
// kernels of the narrow phase find the contact of the bodies (for composites, of the two parts) at
// their poses of that time.
void find_impact_contacts(const MovingSide& a, const MovingSide& b, const Pair* pairs,
                          const FirstTimes& first, WitnessFrame frame, const ImpactColumns& out);

}  // namespace carom
