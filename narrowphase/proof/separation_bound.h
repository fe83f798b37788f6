// How far off a separation may be: forward bounds of the kernels.
#pragma once

#include "narrowphase/batch/batch.h"
#include "narrowphase/pairs/pair_kinds.h"

namespace carom {

// In shares of the pair's size, the greatest number of its shapes and of the way between them.
double separation_share(ShapeKind a, ShapeKind b);

// Fills batch.out.separation_bound.
void bound_separations(const PairKind& kind, const Batch& batch);

}  // namespace carom
