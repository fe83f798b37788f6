// Which edges of a surface are inner ones.
#pragma once

#include <array>
#include <cstddef>

#include "shapes/turn.h"

namespace carom {

// The sides of a triangle from which one of its edges is inner (MeshGeometry::inner_edges()).
struct InnerSides {
  bool from_front, from_back;
};

// Edge `index` goes from that corner to the next. `across` is the third corner of the only other
// triangle there; both triangles have an area.
InnerSides inner_sides(const std::array<Double3, 3>& corners, size_t index, const Double3& across);

}  // namespace carom
