// What rounding may do to a time of impact, and what is made of it.
#pragma once

namespace carom {

// By this share of all lengths that go in, shapes are grown before the time at which they meet is
// computed: more than the arithmetic rounds (some 20 units of 2^-53), so that a time is never late.
// Balls that graze each other are met early by its root at most, 1e-6 of their size.
inline constexpr double kSweepSlack = 0x1p-46;

// Past the ends of an edge, as a share of it, and of a face: what of a rounded shape lies there is
// the next feature's. Rounding must not open a seam between the two.
inline constexpr double kSeam = 0x1p-40;

// A face whose sides have a sine below this is no wider than that: its edges, grown by its width,
// do for it.
inline constexpr double kThinFace = 0x1p-40;

// Below this, and not thin, its normal is too rounded: the pair is left to advancement. Faces are
// grown by so much of the slack, over the sine.
inline constexpr double kSlantedFace = 0x1p-10;
inline constexpr double kFaceSlack = 0.25;

// In place of a time: there is no closed form for this pair, or it would not be exact enough.
inline constexpr double kNoClosedForm = -1;

}  // namespace carom
