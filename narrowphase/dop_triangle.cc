// K-DOP against triangle: one pair at a time.
#include "narrowphase/scalar_batch.h"

namespace carom {

void run_dop_triangle(const Batch& batch) {
  run_scalar_batch(batch, ShapeKind::dop, ShapeKind::triangle);
}

}  // namespace carom
