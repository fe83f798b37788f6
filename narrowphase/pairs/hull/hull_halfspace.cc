// Hull against half-space: one pair at a time.
#include "narrowphase/pairs/scalar_batch.h"

namespace carom {

void run_hull_halfspace(const Batch& batch) {
  run_scalar_batch(batch, ShapeKind::hull, ShapeKind::halfspace);
}

}  // namespace carom
