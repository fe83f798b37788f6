#include "narrowphase/pairs/round/solid_cylinder.h"

namespace carom {

void run_aabb_cylinder(const Batch& batch) { run_solid_cylinder<Aabb>(batch); }

}  // namespace carom
