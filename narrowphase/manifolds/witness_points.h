// Manifolds of one point.
#pragma once

#include "narrowphase/batch/batch.h"

namespace carom {

// Makes the witness point on A the manifold of each pair that touches, and clears that of the
// others. A pair touches if it overlaps, or is separate by no more than its reach.
void copy_witnesses(const Batch& batch);

}  // namespace carom
