// Distances of points from the surfaces of round shapes, in long double.
#pragma once

#include <optional>

#include "carom/shapes/shape.h"
#include "oracle/vec3.h"

namespace carom::oracle {

// The distance of a point of the shape's frame from the surface of a cylinder, cone or ellipsoid,
// inside or outside; nothing for other kinds. A shape without volume is all surface.
std::optional<long double> round_surface_distance(const Shape& shape,
                                                  const Vec3<long double>& point);

}  // namespace carom::oracle
