// Every tolerance of the project, with its reason. All are relative.
#pragma once

namespace carom {

// Separations below this share of the pair's size are computed again in double precision: float32
// rounding is at most 5 units of 2^-24 there, a third of this.
inline constexpr float kNearTouch = 0x1p-20f;

// The same for shapes that are turned, in scaled units (coordinates up to two): rotations and the
// products that follow round to at most 30 units of 2^-24, a quarter of this.
inline constexpr float kNearTouchScaled = 0x1p-17f;

// Points nearer than this in scaled units are taken for one: the square of their distance is about
// to vanish in float32.
inline constexpr float kCoincident = 0x1p-50f;

// Nearer than this to the inside of a segment, what rounding leaves along it counts beside the way
// across.
template <class Real>
inline constexpr Real kNearSegment = Real(0x1p-16);
template <>
inline constexpr double kNearSegment<double> = 0x1p-44;

// Quaternions whose squares neither vanish nor overflow are used as they are; others are scaled by
// a power of two first, which changes no bit of their rotation.
inline constexpr float kLeastSquaredNorm = 0x1p-60f;
inline constexpr float kGreatestSquaredNorm = 0x1p60f;

}  // namespace carom
