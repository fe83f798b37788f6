// Sphere against hull: searches over any two cores.
#include "narrowphase/core_batch.h"

namespace carom {

void run_sphere_hull(const Batch& batch) { run_core_batch<Sphere, Hull>(batch); }

}  // namespace carom
