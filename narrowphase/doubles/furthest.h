// The point of a core that is furthest along a direction, on the ISA in use.
#pragma once

#include "narrowphase/doubles/core.h"

namespace carom {

// The same index as scalar::furthest_point() gives, on every ISA. To be asked for once a batch.
FurthestPoint furthest_point_in_lanes();

}  // namespace carom
