// Tolerances of tests against half-spaces, in scaled units, with their reasons.
#pragma once

namespace carom {

// Faces, edges and capsules whose ends differ in height by less than this share of the shape's size
// lie flat: rotations round to at most 8 units of 2^-24. Their middle is a point that stays put.
inline constexpr float kLyingFlat = 0x1p-21f;

// How many times greater than a shape the numbers may be that place the plane, before their
// rounding in float32 (4 units of 2^-24 at the most that was found) is more than 2e-6 of the shape:
// bodies far from the position of a turned half-space, and half-spaces with a great offset.
inline constexpr float kFarPlane = 8.0f;

}  // namespace carom
