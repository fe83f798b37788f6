// How large bodies are.
#pragma once

#include "carom/shapes/shape.h"

namespace carom::accuracy {

// The radius of the ball about the body's position that holds the shape (of k-DOPs: that holds
// their box); infinite for half-spaces.
double bounding_radius(const Shape& shape);

// The longest by the shortest edge of a box about the shape, in the body's frame; of triangles the
// longest edge by the height above it. 1 for spheres and half-spaces; infinite for what is flat.
double aspect(const Shape& shape);

}  // namespace carom::accuracy
