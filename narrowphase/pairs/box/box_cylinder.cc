#include "narrowphase/pairs/round/solid_cylinder.h"

namespace carom {

void run_box_cylinder(const Batch& batch) { run_solid_cylinder<Box>(batch); }

}  // namespace carom
