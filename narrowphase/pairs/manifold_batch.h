// The manifold pass of kinds whose kernel may defer rows.
#pragma once

#include "narrowphase/batch/batch.h"

namespace carom {

// `in_lanes` writes the points that it knows and marks the other rows as unsure. Those follow one
// at a time, with the bits of the reference.
void run_manifolds(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b,
                   void (*in_lanes)(const Batch&));

// The same where no points are found in lanes.
void run_manifolds_one_by_one(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b);

}  // namespace carom
