// Capsule against hull: searches over any two cores.
#include "narrowphase/core_batch.h"

namespace carom {

void run_capsule_hull(const Batch& batch) { run_core_batch<Capsule, Hull>(batch); }

}  // namespace carom
