// Every tolerance of the project, with its reason. All are relative.
#pragma once

namespace carom {

// Separations below this share of the pair's size are computed again in double precision: float32
// rounding is at most 5 units of 2^-24 there, a third of this.
inline constexpr float kNearTouch = 0x1p-20f;

}  // namespace carom
