// Hull against triangle: searches over any two cores.
#include "narrowphase/core_batch.h"

namespace carom {

void run_hull_triangle(const Batch& batch) { run_core_batch<Hull, Triangle>(batch); }

}  // namespace carom
