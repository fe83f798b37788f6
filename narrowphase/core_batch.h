// Batches of two kinds that meet as cores: one pair at a time, with furthest points found in lanes.
#pragma once

#include "narrowphase/batch.h"

namespace carom {

// A and B: types of shapes, as in Shape. The bits are those of the reference on every ISA, since
// the furthest points are.
template <class A, class B>
void run_core_batch(const Batch& batch);

}  // namespace carom
