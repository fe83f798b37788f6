// Where the corners of a shell are: the scalar form.
#pragma once

#include <bit>

#include "narrowphase/hulls/shell.h"
#include "narrowphase/hulls/solid.h"

namespace carom::scalar {

inline void place_corners(const Shell& shell, const Solid& a, const PointView& b,
                          ShellSpace& space) {
  for (uint32_t left = shell.corners; left != 0; left &= left - 1) {
    const auto i = static_cast<size_t>(std::countr_zero(left));
    const Vector3f corner = a.corner(shell.of_a[i]) - b[shell.of_b[i]];
    for (size_t axis = 0; axis < 3; ++axis) {
      space.corner[axis][i] = corner[static_cast<int>(axis)];
    }
  }
}

}  // namespace carom::scalar
