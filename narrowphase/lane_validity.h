// The rare path of a batch: which pairs have no answer.
#pragma once

#include "carom/kernel/shape.h"
#include "narrowphase/batch.h"

namespace carom {

// Whether both bodies of row `row` are valid.
bool is_valid_pair(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b, size_t row);

}  // namespace carom
