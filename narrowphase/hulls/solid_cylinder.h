// The widest gap between a solid and a cylinder, found in lanes: one pair, a feature a lane.
#pragma once

#include "narrowphase/hulls/solid_cylinder_scalar.h"

namespace carom {

using FindSolidWay = scalar::SolidWay (*)(const Solid& solid,
                                          const scalar::PlacedCylinder& cylinder);

// On the ISA in use; as scalar::find_solid_way().
FindSolidWay find_solid_way_in_lanes();

}  // namespace carom
