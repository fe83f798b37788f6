// The radius of a ball that holds a shape, and the diameter of a ball that fits into it.
#pragma once

#include "carom/shapes/shape.h"

namespace carom::reference {

// The radius of a ball about the body's position that holds the shape, however it is turned; at
// most the largest float. The shape must be valid.
float bounding_radius(const Shape& shape);

// The diameter of a ball inside the shape; 0 if none is known.
double inner_diameter(const Shape& shape);

}  // namespace carom::reference
