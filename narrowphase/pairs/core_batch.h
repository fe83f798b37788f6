// Batches of two kinds that meet as cores: many pairs at a time in float32, and those that it
// leaves one at a time in double precision, with furthest points found in lanes.
#pragma once

#include "narrowphase/batch/batch.h"

namespace carom {

// A and B: types of shapes, as in Shape. `in_lanes` tests what float32 can decide, and marks the
// other rows as unsure; nullptr: it can decide none. The bits of those are those of the reference
// on every ISA, since the furthest points are.
template <class A, class B>
void run_core_batch(const Batch& batch, void (*in_lanes)(const Batch&));

}  // namespace carom
