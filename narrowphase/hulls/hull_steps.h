// The steps of the float32 penetration search in lanes, for the ISA in use.
#pragma once

#include "narrowphase/hulls/hull_depth.h"

namespace carom {

const HullSteps& hull_steps_in_lanes();

}  // namespace carom
