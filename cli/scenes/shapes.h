// Converts shapes of files to shapes of the library.
#pragma once

#include <string>
#include <vector>

#include "carom/base/result.h"
#include "carom/shapes/shape.h"
#include "io/shape_arrays.h"

namespace carom::cli {

// `source` names the file in messages. A mesh of one triangle becomes a Triangle, a dop the slabs
// of its vertices, a hull the result of build_hull(). Sizes are not checked, because the
// kernels report invalid shapes; a geometry that cannot be built from invalid numbers is null. The
// set of each shape is then scaled (carom/shapes/scaled.h); shapes that differ in their scale alone
// share a geometry.
// Fails for empty shapes (a hull without vertices, a mesh without triangles, a compound without
// children), unknown dops, height fields that make_height_field() refuses, compounds with
// half-spaces, and scales that scaled() refuses.
Result<std::vector<Shape>> convert_shapes(const io::SceneShapes& shapes, const std::string& source);

// Whether the parameters of a shape of this kind say all of it, so that converting it is cheap and
// never fails, without a scale.
bool is_its_parameters(uint8_t kind);

// Converts one shape of any kind except compound. The error names the cause: "a hull without
// vertices".
Result<Shape> convert_simple_shape(const io::SceneShapes& shapes, size_t index);

// The same for a shape of any kind, a compound with its children.
Result<Shape> convert_shape(const io::SceneShapes& shapes, size_t index);

}  // namespace carom::cli
