// The contacts of pairs at their times of impact.
#pragma once

#include <cstdint>

#include "carom/impacts/time_of_impact.h"
#include "impacts/impact.h"
#include "impacts/simple_times.h"

namespace carom {

// Fills the contact columns of `out` for all rows: those that have a time in [0, 1], and not a
// number for the others. The contact is that of the bodies (of composites: of the two parts)
// placed where they are then, by the kernels of the narrow phase.
void find_impact_contacts(const MovingSide& a, const MovingSide& b, const Pair* pairs,
                          const FirstTimes& first, WitnessFrame frame, const ImpactColumns& out);

}  // namespace carom
