// The diameter of a ball that fits into a shape. A body that moves less than that cannot jump past
// itself.
#pragma once

#include "carom/shapes/views.h"
#include "shapes/body_reader.h"

namespace carom {

// The diameter of a ball inside the shape, up to rounding. For spheres, capsules, boxes and aabbs
// it is the largest one. 0 if none is known: triangles, meshes, and hulls that are no solids. A
// compound has the smallest diameter among its children; a half-space an infinite one. 0 or NaN for
// shapes that are not valid.
double inner_diameter(const BodyReader& reader, size_t i);

}  // namespace carom
