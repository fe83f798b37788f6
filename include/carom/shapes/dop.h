/// @file
/// k-DOPs (discrete oriented polytopes): intersections of k/2 slabs whose directions are fixed.
/// J. Klosowski et al., Efficient Collision Detection Using Bounding Volume Hierarchies of k-DOPs,
/// IEEE TVCG 4(1), 1998.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "carom/export.h"

namespace carom {

/// Which planes a k-DOP has; the value is k.
enum class DopKind : uint8_t {
  k6 = 6,    ///< the faces of a box along the axes
  k14 = 14,  ///< and planes that cut the corners of a cube
  k18 = 18,  ///< the faces, and planes that cut the edges of a cube
  k26 = 26   ///< the faces, corners and edges
};

/// The slabs of the largest k-DOP.
inline constexpr size_t kMostSlabs = 13;
/// How many slabs a k-DOP of this kind has: k/2.
constexpr size_t slab_count(DopKind kind) { return static_cast<size_t>(kind) / 2; }

/// The directions of the slabs, with components -1, 0 and 1. They are not unit vectors: projections
/// are sums of coordinates.
CAROM_EXPORT std::span<const std::array<int8_t, 3>> slab_directions(DopKind kind);

/// The corners, edges and faces of a k-DOP: dop_geometry() finds them.
class DopGeometry;

/// All x of the body's frame with lower[i] <= direction[i] . x <= upper[i] for every slab.
/// lower <= upper, and the slabs have a point in common; a slab may be redundant. Entries behind
/// the last slab are unused. Contacts are those of the hull of its corners, rounded to float32: by
/// at most 2^-24 of its size. Decisions of the exact and certified tiers are those of the slabs.
struct Dop {
  DopKind kind = DopKind::k6;             ///< which slabs
  std::array<float, kMostSlabs> lower{};  ///< lower ends, metres x length of the direction
  std::array<float, kMostSlabs> upper{};  ///< upper ends, likewise
  /// What dop_geometry() found about these slabs. It may be nullptr: then it is found anew at every
  /// use, except in a World, which finds it when the shape is set, once for all equal shapes. It
  /// changes no result, and does not count where the slabs are no longer those it was found from.
  std::shared_ptr<const DopGeometry> geometry = nullptr;

  /// The smallest k-DOP around these points, its slabs rounded to the nearest float; all zero for
  /// no points, NaN where a point is NaN.
  CAROM_EXPORT static Dop of_points(std::span<const Eigen::Vector3f> points, DopKind kind);
};

/// The geometry of a k-DOP (the one that it has, if that is still right); nullptr if its slabs are
/// not valid. It takes up to 50 microseconds to find and 10 KB to keep. Threads may share it.
CAROM_EXPORT std::shared_ptr<const DopGeometry> dop_geometry(const Dop& dop);

}  // namespace carom
