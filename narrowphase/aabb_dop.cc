// Aabb against k-DOP: one pair at a time.
#include "narrowphase/scalar_batch.h"

namespace carom {

void run_aabb_dop(const Batch& batch) { run_scalar_batch(batch, ShapeKind::aabb, ShapeKind::dop); }

}  // namespace carom
