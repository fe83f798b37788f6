// Whether two shapes overlap, exactly as they are stored (carom/results/tier.h). Touching is
// overlap.
#pragma once

#include "narrowphase/batch/stated_body.h"

namespace carom {

// Takes some microseconds; more for k-DOPs, for thick triangles, and for sizes that differ by many
// orders of magnitude.
bool exact_overlap(const StatedBody& a, const StatedBody& b);

}  // namespace carom
