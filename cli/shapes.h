// Shapes of files -> shapes of the library.
#pragma once

#include <string>
#include <vector>

#include "carom/kernel/result.h"
#include "carom/kernel/shape.h"
#include "io/shape_arrays.h"

namespace carom::cli {

// Refuses kinds that have no kernel yet; `source` names the file in the message. A mesh of one
// triangle becomes a Triangle, a dop the slabs of its vertices. Sizes are passed on as they are:
// what is invalid is for the kernels to say.
Result<std::vector<Shape>> convert_shapes(const io::SceneShapes& shapes, const std::string& source);

}  // namespace carom::cli
