// Tolerances of the tests of boxes against segments and triangles, in scaled units.
#pragma once

namespace carom {

// Two edges, or an edge and a face, whose sine is below the root of this have no axis across both:
// the faces' axes differ from it by no more than rounding.
inline constexpr float kParallelSquared = 0x1p-48f;

// A separating axis that leads from one nearest point to the other up to this is the normal:
// rounding of coordinates below two is a quarter of it.
inline constexpr float kSameWay = 0x1p-21f;

// The direction between the nearest points is the normal if it parts the cores by their distance up
// to this; a fifth of what the normal's error may be.
inline constexpr float kCertain = 0x1p-19f;

// The same in double precision.
inline constexpr double kSameWayDouble = 0x1p-40;
inline constexpr double kCertainDouble = 0x1p-30;

}  // namespace carom
