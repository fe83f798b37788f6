// Bounding radius and aspect ratio of shapes.
#pragma once

#include "carom/shapes/shape.h"

namespace carom::accuracy {

// The radius of the ball about the body's position that contains the shape (for a k-DOP: its box).
// Infinite for half-spaces.
double bounding_radius(const Shape& shape);

// The longest edge divided by the shortest of a box about the shape, in the body's frame; for a
// triangle the longest edge divided by the height above it. 1 for spheres and half-spaces; infinite
// for flat shapes.
double aspect(const Shape& shape);

}  // namespace carom::accuracy
