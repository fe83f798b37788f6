// Batches of two kinds that are tested as cores (points grown by a radius). Kernels in lanes test
// many pairs at a time in float32. The rows that they defer follow one at a time in double
// precision, with support points found in lanes.
#pragma once

#include "narrowphase/batch/batch.h"

namespace carom {

// A and B: types of shapes, as in Shape. `in_lanes` tests the rows that float32 can decide and
// marks the others as unsure. Deferred rows have the bits of the
// reference on every ISA, because their support points have.
template <class A, class B>
void run_core_batch(const Batch& batch, void (*in_lanes)(const Batch&));

}  // namespace carom
