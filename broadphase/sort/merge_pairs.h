// The union of two sorted lists of pairs.
#pragma once

#include <vector>

#include "base/parallel.h"
#include "carom/results/pair.h"

namespace carom {

// Replaces `out` by the pairs of both lists, sorted. No pair may be in both.
void merge_pairs(const std::vector<Pair>& a, const std::vector<Pair>& b, Parallelism parallelism,
                 std::vector<Pair>& out);

}  // namespace carom
