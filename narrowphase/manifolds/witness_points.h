// Manifolds of one point.
#pragma once

#include <cstddef>
#include <cstdint>

#include "narrowphase/batch/batch.h"

namespace carom {

// Whether a row has manifold points: it overlaps, or is separate by no more than its reach.
inline bool touches(const Batch& batch, size_t row) {
  const uint8_t overlap = batch.out.overlap[row];
  return overlap == 1 ||
         (batch.reach && overlap == 0 && batch.out.separation[row] <= batch.reach[row]);
}

// Makes the witness point on A the manifold of each row that touches, and clears that of the
// others.
void copy_witnesses(const Batch& batch);

}  // namespace carom
