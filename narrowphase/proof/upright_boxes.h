// Exact decisions about boxes along the world axes, which most that touch exactly are.
#pragma once

#include <array>

#include "shapes/body_reader.h"

namespace carom {

// A box along the world axes: between position + lower and position + upper.
struct UprightBox {
  std::array<double, 3> position;
  std::array<float, 3> lower, upper;
};

// Reads a body as such a box. Returns false unless it is one: an aabb, or a box that is turned by
// quarter turns or not at all.
bool read_upright_box(const BodyReader& body, size_t index, UprightBox& box);

// Without any rounding.
bool do_overlap(const UprightBox& a, const UprightBox& b);

}  // namespace carom
