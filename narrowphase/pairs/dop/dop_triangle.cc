// K-DOP against triangle: the search in double precision over any two cores.
#include "narrowphase/pairs/core_batch.h"

namespace carom {

void run_dop_triangle(const Batch& batch) { run_core_batch<Dop, Triangle>(batch, nullptr); }

}  // namespace carom
