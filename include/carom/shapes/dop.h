// k-DOPs (discrete oriented polytopes): intersections of k/2 slabs whose directions are fixed.
// J. Klosowski et al., Efficient Collision Detection Using Bounding Volume Hierarchies of k-DOPs,
// IEEE TVCG 4(1), 1998.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "carom/export.h"

namespace carom {

// 14 = 6 and the corners of a cube, 18 = 6 and its edges, 26 = all.
enum class DopKind : uint8_t { k6 = 6, k14 = 14, k18 = 18, k26 = 26 };

inline constexpr size_t kMostSlabs = 13;
constexpr size_t slab_count(DopKind kind) { return static_cast<size_t>(kind) / 2; }

// Directions of the slabs, not unit vectors: projections are sums of coordinates.
CAROM_EXPORT std::span<const std::array<int8_t, 3>> slab_directions(DopKind kind);

// All x of the body's frame with lower[i] <= direction[i] . x <= upper[i] for every slab. Slabs
// that others make redundant are allowed; lower <= upper. Entries behind the last slab are unused.
struct Dop {
  DopKind kind = DopKind::k6;
  std::array<float, kMostSlabs> lower{};
  std::array<float, kMostSlabs> upper{};

  // The smallest around these points, its slabs rounded to the nearest float; zero for no points,
  // not a number where a point is not.
  CAROM_EXPORT static Dop of_points(std::span<const Eigen::Vector3f> points, DopKind kind);
};

}  // namespace carom
