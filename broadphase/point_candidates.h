// Points against bounds -> candidate pairs (point, body).
#pragma once

#include <vector>

#include "carom/base/parallelism.h"
#include "carom/results/pair.h"
#include "carom/shapes/views.h"

namespace carom {

// All pairs of a point (x, y, z float32, `stride` bytes apart) and a box of `bounds` that holds it,
// sorted by (point, box). Points with NaN are in no box.
std::vector<Pair> find_point_candidates(const float* xyz, size_t count, size_t stride,
                                        const BoundsView& bounds, Parallelism parallelism);

}  // namespace carom
