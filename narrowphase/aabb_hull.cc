// Aabb against hull: searches over any two cores.
#include "narrowphase/core_batch.h"

namespace carom {

void run_aabb_hull(const Batch& batch) { run_core_batch<Aabb, Hull>(batch); }

}  // namespace carom
