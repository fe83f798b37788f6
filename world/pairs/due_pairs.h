// Which pairs are due: the sum of the odometers of their bodies has passed a limit.
#pragma once

#include <cstddef>
#include <cstdint>

#include "carom/results/pair.h"

namespace carom {

// More entries than pairs that find_due_pairs() may write.
inline constexpr size_t kDuePadding = 16;

// Writes the indices of the pairs among [begin, end) that are due, ascending, and returns their
// number. `until`: one limit a pair; `travelled`: one odometer a body (world/changes/drift.h). The
// same on every instruction set.
size_t find_due_pairs(const Pair* pairs, const uint32_t* until, const uint32_t* travelled,
                      size_t begin, size_t end, uint32_t* due);

}  // namespace carom
