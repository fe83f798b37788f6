#include "narrowphase/pairs/round/solid_cylinder.h"

namespace carom {

void run_cylinder_triangle(const Batch& batch) { run_solid_cylinder<Triangle>(batch); }

}  // namespace carom
