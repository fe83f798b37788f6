// Forward error bounds of the separations that the kernels compute.
#pragma once

#include "narrowphase/batch/batch.h"
#include "narrowphase/pairs/pair_kinds.h"

namespace carom {

// The bound as a share of the pair's size: the greatest number of its shapes and of the vector
// between their positions.
double separation_share(ShapeKind a, ShapeKind b);

// Fills batch.out.separation_bound.
void bound_separations(const PairKind& kind, const Batch& batch);

}  // namespace carom
