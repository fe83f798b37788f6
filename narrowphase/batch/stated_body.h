// One body read out of its columns, for code that takes bodies one at a time.
#pragma once

#include "carom/shapes/body.h"
#include "shapes/body_reader.h"

namespace carom {

struct StatedBody {
  Shape shape;
  Position<double> position;
  Row orientation;  // x, y, z, w; any length but zero
};

// An upper bound of the coordinates of a shape, in metres, within a factor of two.
double size_of(const Shape& shape);

// It does not own its geometry.
Shape shape_of(const BodyReader& body, size_t index);
StatedBody stated_body(const BodyReader& body, size_t index);

}  // namespace carom
