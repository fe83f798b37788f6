// Runs a batch with hulls in place of k-DOPs.
#pragma once

#include "narrowphase/batch/batch.h"

namespace carom {

// The sides of a batch that are k-DOPs.
struct DopSides {
  bool a = false;
  bool b = false;
};

// Runs the batch of a kernel for hulls. Each k-DOP is the hull of its corners
// (DopGeometry::hull()): the one that the batch knows, or one that is found for this call.
void run_with_hulls(const Batch& batch, DopSides dops, void (*run)(const Batch&));

}  // namespace carom
