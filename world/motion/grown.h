// Ends of bounds that are moved outwards.
#pragma once

#include <cmath>

namespace carom {

// v - margin rounded outwards, by a little more than in base/outward.h but in fewer steps: the sum
// is off by at most half a unit in the last place, and `step` is one unit or two.
inline float below(float v, float margin) {
  const float sum = v - margin;
  const float step = 0x1p-23f * std::abs(sum);
  return sum - step;
}

inline float above(float v, float margin) { return -below(-v, margin); }

}  // namespace carom
