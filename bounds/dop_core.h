// Shapes as Minkowski sums of simple ones: the hull of three points, or of ellipsoids about them, a
// box with any axes, and a ball. The reach of a sum in a direction is the sum of their reaches.
#pragma once

#include <array>

#include "shapes/body_reader.h"
#include "shapes/turn.h"

namespace carom {

struct DopCore {
  std::array<Double3, 3> points{};  // relative to the position; some coincide if there are fewer
  // The ellipsoid about a point has these half axes, times the point's share.
  bool is_round = false;
  std::array<Double3, 3> half_axes{};
  std::array<double, 3> shares{};
  std::array<Double3, 3> edges{};  // half edges of the box; zero if there are fewer
  double radius = 0;
  double size = 0;  // at least the greatest coordinate of the shape in its own frame
};

// The body must be valid and no half-space.
DopCore dop_core(const BodyReader& reader, size_t i);

}  // namespace carom
