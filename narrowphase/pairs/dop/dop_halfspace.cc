// K-DOP against half-space: one pair at a time.
#include "narrowphase/pairs/scalar_batch.h"

namespace carom {

void run_dop_halfspace(const Batch& batch) {
  run_scalar_batch(batch, ShapeKind::dop, ShapeKind::halfspace);
}

}  // namespace carom
