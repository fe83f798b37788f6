// Witness points of a whole batch in world coordinates.
#pragma once

#include "narrowphase/batch/batch.h"

namespace carom {

// Moves the witness points in the columns of a batch, which are relative to the bodies, to world
// coordinates, as kernels do that find them in the world. Rows without a contact hold nothing of
// use, before and after.
void move_to_world(const Batch& batch);

}  // namespace carom
