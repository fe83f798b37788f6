// Batches of a shape with faces and a cylinder: one pair at a time, its features in lanes.
#pragma once

#include "narrowphase/batch/batch.h"

namespace carom {

// The kind of A, or of B if A is the cylinder.
template <class SolidShape>
void run_solid_cylinder(const Batch& batch);

}  // namespace carom
