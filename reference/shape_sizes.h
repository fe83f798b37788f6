// How far shapes reach, and how large a ball fits into them.
#pragma once

#include "carom/shapes/shape.h"

namespace carom::reference {

// Of a shape that is turned, and valid: a ball about the body's position of this radius holds it,
// however it is turned. The largest float where it would be more.
float bounding_radius(const Shape& shape);

// The diameter of a ball that lies inside of the shape; 0 where none is known.
double inner_diameter(const Shape& shape);

}  // namespace carom::reference
