// The steps of the search for depths in lanes, on the ISA in use.
#pragma once

#include "narrowphase/hulls/hull_depth.h"

namespace carom {

const HullSteps& hull_steps_in_lanes();

}  // namespace carom
