// The support point of a core, in lanes, for the ISA in use.
#pragma once

#include "narrowphase/doubles/core.h"

namespace carom {

// Gives the same index as scalar::furthest_point() on every ISA. Ask for it once per batch.
FurthestPoint furthest_point_in_lanes();

}  // namespace carom
