// Sphere against k-DOP: the search in double precision over any two cores.
#include "narrowphase/pairs/core_batch.h"

namespace carom {

void run_sphere_dop(const Batch& batch) { run_core_batch<Sphere, Dop>(batch, nullptr); }

}  // namespace carom
