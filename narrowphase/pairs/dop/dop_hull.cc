// K-DOP against hull: searches over any two cores.
#include "narrowphase/pairs/core_batch.h"

namespace carom {

void run_dop_hull(const Batch& batch) { run_core_batch<Dop, Hull>(batch, nullptr); }

}  // namespace carom
