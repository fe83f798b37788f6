/// @file
/// Convex hulls of points (library carom_hulls, which needs Qhull).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "carom/base/result.h"
#include "carom/export.h"
#include "carom/shapes/hull.h"

namespace carom {

/// The dimension of a hull.
enum class HullForm : uint8_t {
  point,    ///< one point
  segment,  ///< two points
  polygon,  ///< flat, with two faces that look in opposite directions
  solid,    ///< with volume
};

/// "point", "segment", "polygon", "solid".
CAROM_EXPORT const char* name(HullForm form);

/// The hull of a set of points.
struct BuiltHull {
  /// Some of the given points, bit for bit and in their order: the corners, each once. Its faces
  /// are polygons, one for each plane up to the rounding of the coordinates, counter-clockwise as
  /// seen from outside.
  std::shared_ptr<const HullGeometry> geometry;
  HullForm form = HullForm::point;  ///< the dimension
  size_t duplicates = 0;            ///< points equal to an earlier one
  size_t inside = 0;                ///< other points that are not corners
};

/// Makes the hull of points, in any order and of any number: one is enough, and they may lie on a
/// line or in a plane. Points count as collinear or coplanar if they are to 1e-12 of their extents.
/// Dropped points lie inside the hull to 1e-9 of the extents. Each axis is scaled separately, so
/// neither the unit nor the proportions matter, from the smallest float to the largest. If Qhull
/// fails, the hull keeps all distinct points and has no faces. Fails if there is no point or one is
/// not finite. Any number of threads may call it at once. C. B. Barber et al., The Quickhull
/// algorithm for convex hulls, ACM Transactions on Mathematical Software 22(4), 1996.
///
/// It decomposes nothing: the hull of points that are not convex fills their hollows. For
/// decompositions use V-HACD or CoACD, and make a compound of the hulls of the parts.
CAROM_EXPORT Result<BuiltHull> build_hull(std::span<const Eigen::Vector3f> points);

}  // namespace carom
