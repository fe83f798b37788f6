// The limits of a height field: its spacings, and its heights.
#pragma once

#include <cfloat>

namespace carom {

// Beyond these a triangle might have no area, so that it would be none of a mesh.
inline constexpr double kMostSlope = 0x1p40, kMostAspect = 0x1p40;

inline bool is_spacing(double step) { return step >= 2 * FLT_MIN && step <= FLT_MAX; }

}  // namespace carom
