// A stable parallel radix sort of 64-bit items by their upper 32 bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/parallel.h"

namespace carom {

// Sorts `items`. The caller keeps `scratch` and `histograms`, which are working memory, between
// calls.
void radix_sort_by_key(std::vector<uint64_t>& items, std::vector<uint64_t>& scratch,
                       std::vector<uint32_t>& histograms, Parallelism parallelism);

}  // namespace carom
