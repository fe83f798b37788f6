// Boxes grown by more than the tests of their shapes may err, so that the search for candidates
// never misses what a test would find.
#pragma once

#include <algorithm>
#include <array>
#include <cfloat>

#include "base/outward.h"
#include "base/tolerances.h"
#include "shapes/body_reader.h"
#include "trees/tree.h"

namespace carom {

// A share of the travelled distance; kImpactSlack is a twentieth of it.
inline constexpr double kTravelSlack = 0x1p-32;

// Grows the box of a body by a share of its reach from the body's position, the origin of the
// tests, and by a smaller share of the travelled distance.
inline TreeBox grown(const TreeBox& box, const Position<double>& position, double travel = 0) {
  const std::array<double, 3> origin = {position.x, position.y, position.z};
  double reach = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    reach =
        std::max(reach, std::max(origin[axis] - box.lower[axis], box.upper[axis] - origin[axis]));
  }
  const double margin = (kSearchSlack * reach + kTravelSlack * travel) + FLT_TRUE_MIN;
  TreeBox result;
  for (size_t axis = 0; axis < 3; ++axis) {
    result.lower[axis] = next_down(static_cast<float>(box.lower[axis] - margin));
    result.upper[axis] = next_up(static_cast<float>(box.upper[axis] + margin));
  }
  return result;
}

}  // namespace carom
