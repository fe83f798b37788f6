// Hull against hull: searches over any two cores.
#include "narrowphase/core_batch.h"

namespace carom {

void run_hull_hull(const Batch& batch) { run_core_batch<Hull, Hull>(batch); }

}  // namespace carom
