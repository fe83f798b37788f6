// Converts shapes for the scene page.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cli/page/shape_table.h"

namespace carom::cli {

// The shortest decimal number that reads back as this float; JSON would print the double with
// meaningless digits.
double shortest(float value);

// The JSON of a shape. Round shapes, boxes and half-spaces have their parameters, compounds the
// places and poses of their children. All others have corners ("points", three numbers each) and
// outlines ("faces", counter-clockwise from outside). The shape must be valid.
nlohmann::ordered_json view_of(const Shape& shape, ShapeTable& shapes);

}  // namespace carom::cli
