/// @file
/// Hulls of fewer points (library carom_hulls, which needs Qhull).
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

/// On which side of the original the simpler hull lies.
enum class HullSide : uint8_t {
  inside,   ///< in it: the points are some of the original ones
  outside,  ///< around it: no point of the original is outside
  both,     ///< about as far outside as inside, which halves the error
};

/// What simplify_hull() may do.
struct SimplifyOptions {
  size_t most_points = 32;            ///< points of the simpler hull, >= 4
  HullSide side = HullSide::outside;  ///< where it lies
};

/// A hull and how far it is from the original.
struct SimplifiedHull {
  std::shared_ptr<const HullGeometry> geometry;  ///< at most SimplifyOptions::most_points points
  /// Metres, an upper bound of the Hausdorff distance of the two hulls: no point of one is further
  /// from the other.
  double error = 0;
};

/// Makes a hull of at most `most_points` points that approximates the hull of `points` (as
/// build_hull() makes it, within 1e-9 of the extents). If that has no more points, it is returned
/// itself. Inside: starts with the point that is furthest from the middle and adds, again and
/// again, the point that is furthest from the hull so far. Outside: the better one of two, the hull
/// from inside, scaled until it contains all points, and the intersection of half-spaces, each of
/// which cuts off the corner that is furthest from the original. Both: the hull from inside, scaled
/// by as much as brings the two errors near each other. The result lies outside by a
/// little more than the rounding of its coordinates, so that it contains every point with
/// certainty.
///
/// The result does not depend on the order of the points. Time grows with most_points times the
/// points of the hull; 2,000 points to 32 take a fraction of a second. Fails if there is no point,
/// one is not finite, most_points is less than 4, or, for HullSide::outside, the points have no
/// volume and most_points is above 64.
CAROM_EXPORT Result<SimplifiedHull> simplify_hull(std::span<const Eigen::Vector3f> points,
                                                  const SimplifyOptions& options = {});

}  // namespace carom
