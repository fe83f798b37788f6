// Boxes of two frames -> which of them differ.
#pragma once

#include <array>
#include <cstdint>

#include "broadphase/box_source.h"

namespace carom {

// Not zero for boxes that differ. Flags after the last box mean nothing.
using BoxFlags = std::array<uint32_t, BoxBlock::kBoxes>;

// Replaces `differs` by flags of the boxes of `now` whose bits are not those of `last`: six
// columns, those of the lower corners first. BoxBlock::kPadding more rows of them can be read.
// Returns whether there are any.
bool compare_boxes(const BoxBlock& now, const std::array<const float*, 6>& last, BoxFlags& differs);

}  // namespace carom
