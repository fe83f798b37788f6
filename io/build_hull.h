// Convex hulls of points, with Qhull.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>

#include "carom/base/result.h"
#include "carom/shapes/hull.h"

namespace carom::io {

// What the hull of the points is.
enum class HullForm : uint8_t { point, segment, polygon, solid };

const char* name(HullForm form);

// The points of `geometry` are a part of the points that were given, bit for bit and in their
// order; its faces are polygons, one for each plane up to the rounding of the coordinates.
struct BuiltHull {
  std::shared_ptr<const HullGeometry> geometry;
  HullForm form = HullForm::point;
  size_t duplicates = 0;  // points that were there before
  size_t inside = 0;      // other points that are no corners
};

// Points lie on a line or in a plane if they do to 1e-12 of their extents; what is left out is
// inside to 1e-9 of them. Each axis is scaled for itself, so that neither the unit nor the
// proportions matter, from the smallest float to the largest. Where Qhull fails, all distinct
// points are kept, and there are no faces. Fails if there is no point or one is not finite.
Result<BuiltHull> build_hull(std::span<const Eigen::Vector3f> points);

}  // namespace carom::io
