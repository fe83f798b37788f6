// Shapes of files -> shapes of the library.
#pragma once

#include <string>
#include <vector>

#include "carom/base/result.h"
#include "carom/shapes/shape.h"
#include "io/shape_arrays.h"

namespace carom::cli {

// `source` names the file in messages. A mesh of one triangle becomes a Triangle, a dop the slabs
// of its vertices, a hull what io::build_hull() makes of them. Sizes are passed on as they are:
// what is invalid is for the kernels to say, and a geometry that cannot be made of invalid numbers
// is not there. Fails for shapes of nothing (a hull without vertices, a mesh without triangles, a
// compound without children), unknown dops, and compounds with half-spaces.
Result<std::vector<Shape>> convert_shapes(const io::SceneShapes& shapes, const std::string& source);

// One of them, of any kind but compounds. The error says what it is: "a hull without vertices".
Result<Shape> convert_simple_shape(const io::SceneShapes& shapes, size_t index);

}  // namespace carom::cli
