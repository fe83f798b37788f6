// Boxes grown by more than tests of the shapes in them may err, so that what a test finds is never
// left out by the search for candidates.
#pragma once

#include <algorithm>
#include <cfloat>

#include "kernel/outward.h"
#include "kernel/tolerances.h"
#include "kernel/tree.h"

namespace carom {

// Of a distance that is travelled; kImpactSlack is a twentieth of it.
inline constexpr float kTravelSlack = 0x1p-32f;

// Grows the box by a share of its size, and a smaller one of the way that its shape goes.
inline TreeBox grown(const TreeBox& box, float travel = 0) {
  float size = 0;
  for (size_t axis = 0; axis < 3; ++axis) size = std::max(size, box.upper[axis] - box.lower[axis]);
  const float margin =
      (static_cast<float>(kSearchSlack) * size + kTravelSlack * travel) + FLT_TRUE_MIN;
  TreeBox result;
  for (size_t axis = 0; axis < 3; ++axis) {
    result.lower[axis] = sum_downwards(box.lower[axis], -margin);
    result.upper[axis] = sum_upwards(box.upper[axis], margin);
  }
  return result;
}

}  // namespace carom
