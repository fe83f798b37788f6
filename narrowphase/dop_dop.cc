// K-DOP against k-DOP: one pair at a time.
#include "narrowphase/scalar_batch.h"

namespace carom {

void run_dop_dop(const Batch& batch) { run_scalar_batch(batch, ShapeKind::dop, ShapeKind::dop); }

}  // namespace carom
