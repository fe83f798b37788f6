// K-DOP against hull: the search in double precision over any two cores.
#include "narrowphase/pairs/core_batch.h"

namespace carom {

void run_dop_hull(const Batch& batch) { run_core_batch<Dop, Hull>(batch, nullptr); }

}  // namespace carom
