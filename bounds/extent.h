// How far shapes reach from their position along the world axes.
#pragma once

#include <array>

#include "shapes/body_reader.h"

namespace carom {

// Corners of a box relative to the position. Not a number if the body's orientation or shape is not
// valid.
struct Extent {
  std::array<float, 3> lower, upper;
};

// Exact for spheres and aabbs, rounded outwards for shapes that are turned. Half-spaces have none:
// zero, or not a number.
Extent extent_of(const BodyReader& reader, size_t i);

}  // namespace carom
