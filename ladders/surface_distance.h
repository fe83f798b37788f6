// How far one surface of triangles is from another, proved.
#pragma once

#include "carom/shapes/mesh_geometry.h"

namespace carom::ladders {

// An upper bound of the distance of every point of `from` to the nearest point of `to`, metres.
// Infinite if it may be more than `most`. Triangles without area do not count. A triangle is as
// near as its furthest corner to some one triangle of `to`, since the distance from a convex set is
// convex; one that is too far by that is divided in four, as often as it helps.
double furthest(const MeshGeometry& from, const MeshGeometry& to, double most);

}  // namespace carom::ladders
