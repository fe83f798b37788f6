// Sorted lists of pairs: their union, and what one has that the other lacks.
#pragma once

#include <vector>

#include "base/parallel.h"
#include "carom/results/pair.h"

namespace carom {

// Replaces `out` by the pairs of both lists, sorted. No pair is in both.
void merge_pairs(const std::vector<Pair>& a, const std::vector<Pair>& b, Parallelism parallelism,
                 std::vector<Pair>& out);

}  // namespace carom
