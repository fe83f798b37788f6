// Shapes as the page of a scene draws them.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cli/page/shape_table.h"

namespace carom::cli {

// The shortest decimal number that is this float: a double would be written with digits that mean
// nothing.
double shortest(float value);

// The parameters of round shapes, boxes and half-spaces; corners ("points", three numbers each) and
// outlines ("faces", counter-clockwise from outside) of all others; places and poses of children.
// The shape must be valid.
nlohmann::ordered_json view_of(const Shape& shape, ShapeTable& shapes);

}  // namespace carom::cli
