// Points and bounds -> candidate pairs (point, body).
#pragma once

#include <vector>

#include "carom/base/parallelism.h"
#include "carom/results/pair.h"
#include "carom/shapes/views.h"

namespace carom {

// All pairs of a point (x, y, z in float32, `stride` bytes apart) and a box of `bounds` that holds
// it, sorted by (point, box). A point with a NaN is in no box.
std::vector<Pair> find_point_candidates(const float* xyz, size_t count, size_t stride,
                                        const BoundsView& bounds, Parallelism parallelism);

}  // namespace carom
