// K-DOP against k-DOP: searches over any two cores.
#include "narrowphase/pairs/core_batch.h"

namespace carom {

void run_dop_dop(const Batch& batch) { run_core_batch<Dop, Dop>(batch, nullptr); }

}  // namespace carom
