#include "narrowphase/pairs/round/solid_cylinder.h"

namespace carom {

void run_hull_cylinder(const Batch& batch) { run_solid_cylinder<Hull>(batch); }

}  // namespace carom
