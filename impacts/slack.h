// Tolerances of times of impact.
#pragma once

namespace carom {

// Shapes are grown by this share of all input lengths before their time of impact is computed. It
// exceeds the rounding (some 20 units of 2^-53), so no time is late. Balls that graze each other
// meet too early by at most the root of it, 1e-6 of their size.
inline constexpr double kSweepSlack = 0x1p-46;

// Edges and faces are extended past their ends by this share. The neighbouring feature covers what
// lies beyond, and rounding must not open a seam between the two.
inline constexpr double kSeam = 0x1p-40;

// A face whose sides have a sine below this is thin: its edges, grown by its width, replace it.
inline constexpr double kThinFace = 0x1p-40;

// A face with a sine below this that is not thin has too rounded a normal, so advancement takes the
// pair. Other faces are grown by kFaceSlack times the slack, divided by the sine.
inline constexpr double kSlantedFace = 0x1p-10;
inline constexpr double kFaceSlack = 0.25;

// Searches for the triangles of a mesh on a path: shapes, rays and tests are off by less than this
// share of all lengths.
inline constexpr double kPathSlack = 0x1p-33;
// Float32 changes a path by less than this share of the lengths on it.
inline constexpr double kFloatSlack = 0x1p-20;
// Longer paths are left to the search in double precision.
inline constexpr double kLongestPath = 0x1p100;

// Stands for a time where the pair has no closed form that is exact enough.
inline constexpr double kNoClosedForm = -1;

}  // namespace carom
