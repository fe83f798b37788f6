// Ends of bounds that are moved outwards.
#pragma once

#include <cmath>
#include <limits>

namespace carom {

// v - margin rounded outwards, by a little more than in base/outward.h but in fewer steps: the sum
// is off by at most half a unit in the last place, and `step` is one unit or two.
inline float below(float v, float margin) {
  const float sum = v - margin;
  const float step = 0x1p-23f * std::abs(sum);
  return sum - step;
}

inline float above(float v, float margin) { return -below(-v, margin); }

// By how much the bounds of a body with contact distance `own` grow in a world with `of_world`,
// which is not more: half of the world's distance, and all that the body's own exceeds it by. Two
// bodies whose separation is at most the larger one of their distances have bounds that then
// overlap.
inline float contact_growth(float of_world, float own) {
  const auto sum = static_cast<float>(of_world / 2.0 + (double{own} - of_world));
  return std::nextafter(sum, std::numeric_limits<float>::max());
}

}  // namespace carom
