// How far a shape reaches from its body's position along the world axes.
#pragma once

#include <array>

#include "shapes/body_reader.h"

namespace carom {

// Corners of a box relative to the position. NaN if the body's orientation or shape is not valid.
struct Extent {
  std::array<float, 3> lower, upper;
};

// Exact for spheres and aabbs, rounded outwards for turned shapes. Meaningless for half-spaces:
// zero or NaN.
Extent extent_of(const BodyReader& reader, size_t i);

}  // namespace carom
