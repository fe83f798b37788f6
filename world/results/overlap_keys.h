// The pairs of a step that overlap.
#pragma once

#include <cstdint>
#include <span>

#include "carom/results/pair.h"

namespace carom {

// Lists write a whole vector behind their last number.
inline constexpr size_t kOverlapsBeyond = 16;

// Writes pair_key() and `contact` of each pair whose overlap is 1, in their order, and returns how
// many there are. There must be room for all pairs and kOverlapsBeyond more.
size_t list_overlaps(std::span<const Pair> pairs, const uint8_t* overlap, const uint32_t* contact,
                     uint64_t* keys, uint32_t* contacts);

}  // namespace carom
