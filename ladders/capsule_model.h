// Capsules and balls that stand for other shapes.
#pragma once

#include <optional>

#include "carom/shapes/rungs.h"

namespace carom::ladders {

// A capsule, or a ball, which is a capsule without length, near a hull, a mesh or a compound, and
// how far it is from it at most; the nearest of some. Nothing for shapes with one-sided or thick
// triangles, and for those that are not bounded.
std::optional<Rung> capsule_model(const Shape& shape);

}  // namespace carom::ladders
