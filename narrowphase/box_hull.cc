// Box against hull: searches over any two cores.
#include "narrowphase/core_batch.h"

namespace carom {

void run_box_hull(const Batch& batch) { run_core_batch<Box, Hull>(batch); }

}  // namespace carom
