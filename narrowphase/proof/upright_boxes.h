// Exact decisions about boxes along the world axes, which most that touch exactly are.
#pragma once

#include <optional>

#include "narrowphase/batch/stated_body.h"

namespace carom {

// Whether two boxes overlap, without any rounding. Nothing unless both are along the world axes:
// aabbs, and boxes that are turned by quarter turns or not at all.
std::optional<bool> upright_boxes_overlap(const StatedBody& a, const StatedBody& b);

}  // namespace carom
