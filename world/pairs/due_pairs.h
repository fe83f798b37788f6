// Which pairs are due: the sum of the odometers of their bodies has passed a limit.
#pragma once

#include <cstddef>
#include <cstdint>

#include "carom/results/pair.h"

namespace carom {

// More entries than pairs that these functions may write to `due`.
inline constexpr size_t kDuePadding = 16;

// Writes the indices of the pairs among [begin, end) that are due when their bodies have travelled
// `ahead` more together, ascending, and returns their number. `until`: one limit a pair;
// `travelled`: one odometer a body (world/changes/drift.h). The same on every instruction set.
size_t find_due_pairs(const Pair* pairs, const uint32_t* until, const uint32_t* travelled,
                      uint32_t ahead, size_t begin, size_t end, uint32_t* due);

// The same of a list: pairs[k] is the pair with index number[k], and its limit until[number[k]].
// Writes those of the numbers whose pairs are due now.
size_t find_due_of_list(const Pair* pairs, const uint32_t* number, const uint32_t* until,
                        const uint32_t* travelled, size_t begin, size_t end, uint32_t* due);

}  // namespace carom
