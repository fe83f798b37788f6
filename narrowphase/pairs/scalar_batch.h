// Batches of kinds that have no kernel in lanes: one pair at a time, in double precision, by the
// scalar tests. The results have the bits of the reference on every ISA.
#pragma once

#include "narrowphase/batch/batch.h"

namespace carom {

void run_scalar_batch(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b);

// The manifold pass of such a batch, or of any other. `wanted`: one flag a row; nullptr: all rows.
void run_scalar_manifolds(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b,
                          const uint8_t* wanted = nullptr);

}  // namespace carom
