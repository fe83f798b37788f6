// How large a ball fits into a shape: a body that moves less than that cannot jump over itself.
#pragma once

#include "carom/shapes/views.h"
#include "shapes/body_reader.h"

namespace carom {

// The diameter of a ball that lies inside of the shape, up to rounding; of spheres, capsules, boxes
// and aabbs the largest there is. 0: none is known, as of triangles, meshes and hulls that are no
// solids. Of compounds that of the child with the smallest one; of half-spaces infinite. 0 or not a
// number for shapes that are not valid.
double inner_diameter(const BodyReader& reader, size_t i);

}  // namespace carom
