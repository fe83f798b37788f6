/// @file
/// Height fields: surfaces over a grid of heights.
#pragma once

#include <memory>

namespace carom {

class HeightFieldGeometry;  // carom/shapes/height_field_geometry.h: made by make_height_field()

/// A surface over a grid of heights, which turns with its body. Without geometry it is not valid.
struct HeightField {
  std::shared_ptr<const HeightFieldGeometry> geometry;  ///< may be shared
};

}  // namespace carom
