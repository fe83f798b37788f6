// Batches of two kinds that are tested as cores (points grown by a radius). Kernels in lanes test
// many pairs at a time in float32. The rows that they defer follow one at a time in double
// precision, with support points found in lanes.
#pragma once

#include "narrowphase/batch/batch.h"

namespace carom {

// A kernel in lanes that tests the rows that float32 can decide and marks the others as unsure.
// Decisions alone may be faster in narrower vectors (simd/measured_kernels.h); what follows from
// them gains from wide ones.
struct CoreKernels {
  void (*for_decisions)(const Batch&);
  void (*for_all_else)(const Batch&);
};

// A and B: types of shapes, as in Shape. Deferred rows have the bits of the reference on every ISA,
// because their support points have.
template <class A, class B>
void run_core_batch(const Batch& batch, const CoreKernels& kernels);

}  // namespace carom
