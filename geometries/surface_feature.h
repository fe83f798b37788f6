// Names the vertex, edge or face of a shape that a point of its surface lies on.
#pragma once

#include <cstdint>

#include "geometries/part.h"

namespace carom {

inline constexpr uint32_t kNoTriangle = 0xffffffffu;

// The name of the feature of a simple part at `point`, which is in the part's frame and lies on its
// surface up to rounding: points of one feature have one name, never 0, and points of different
// features different ones, but for a chance of about 2^-30. `triangle`: for a part that is a
// surface, the triangle that has the point. Triangles that share a corner or an edge share its
// name.
uint32_t surface_feature(const Part& part, uint32_t triangle, const Double3& point);

// The name of a feature of a child of a compound. That of child 0 is the feature itself, as for a
// body that is no compound.
uint32_t feature_of_child(uint32_t child, uint32_t feature);

}  // namespace carom
