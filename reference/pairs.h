// Boxes -> pairs by brute force.
#pragma once

#include <span>
#include <vector>

#include "carom/reference/reference.h"

namespace carom::reference {

// All pairs a < b of rows of `boxes` that overlap, sorted. No box may be empty.
std::vector<Pair> overlapping_pairs(std::span<const Box> boxes);

}  // namespace carom::reference
