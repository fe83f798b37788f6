// Random hulls, meshes and compounds for generated scenes.
#pragma once

#include <cstdint>

#include "carom/shapes/shape.h"
#include "io/generate/random.h"
#include "io/shape_arrays.h"

namespace carom::io {

// Whether make_shape() knows the kind.
constexpr bool is_made(ShapeKind kind) { return has_geometry(kind); }

// Fills shape `index` of `shapes`, whose arrays of kinds, params and ranges are there, within the
// ball of that diameter about the origin. Children of compounds are appended as further shapes.
//   hull      8 to 24 points of the ball's surface
//   mesh      a closed surface of 32 triangles with 18 corners, half of them drawn inwards
//   compound  a ball, a capsule, a box and a hull, some of them turned, that overlap
void make_shape(ShapeKind kind, double diameter, Random& random, size_t index, SceneShapes& shapes);

// Resizes all arrays to `count` shapes; new ones have this kind.
void resize_shapes(ShapeKind kind, size_t count, SceneShapes& shapes);

}  // namespace carom::io
