// One body as it is stored, for what is computed of it alone.
#pragma once

#include "carom/shapes/body.h"
#include "shapes/body_reader.h"

namespace carom {

struct StatedBody {
  Shape shape;
  Position<double> position;
  Row orientation;  // x, y, z, w; any length but zero
};

// The greatest number of a shape, in metres, within a factor of two.
double size_of(const Shape& shape);

Shape shape_of(const BodyReader& body, size_t index);
StatedBody stated_body(const BodyReader& body, size_t index);

}  // namespace carom
