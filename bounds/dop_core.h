// Shapes as sums of simple ones: the hull of three points, a box of any axes, and a ball. How far a
// sum reaches in a direction is the sum of how far each of them does.
#pragma once

#include <array>

#include "shapes/body_reader.h"
#include "shapes/turn.h"

namespace carom {

struct DopCore {
  std::array<Double3, 3> points{};  // relative to the position; equal ones where there are fewer
  std::array<Double3, 3> edges{};   // half edges of the box; zero where it has fewer
  double radius = 0;
  double size = 0;  // greatest coordinate of the shape in its own frame, at least
};

// The body is valid, and no half-space.
DopCore dop_core(const BodyReader& reader, size_t i);

}  // namespace carom
