// Convex hulls of points, with Qhull.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>

#include "carom/base/result.h"
#include "carom/shapes/hull.h"

namespace carom::io {

// The dimension of the hull.
enum class HullForm : uint8_t { point, segment, polygon, solid };

const char* name(HullForm form);

// `geometry` holds some of the given points, bit for bit and in their order. Its faces are
// polygons, one for each plane up to the rounding of the coordinates.
struct BuiltHull {
  std::shared_ptr<const HullGeometry> geometry;
  HullForm form = HullForm::point;
  size_t duplicates = 0;  // points equal to an earlier one
  size_t inside = 0;      // other points that are not corners
};

// Points count as collinear or coplanar if they are to 1e-12 of their extents. Dropped points lie
// inside the hull to 1e-9 of the extents. Each axis is scaled separately, so neither the unit nor
// the proportions matter, from the smallest float to the largest. If Qhull fails, the hull keeps
// all distinct points and has no faces. Fails if there is no point or one is not finite.
Result<BuiltHull> build_hull(std::span<const Eigen::Vector3f> points);

}  // namespace carom::io
