// The points, edges and faces of a k-DOP, in double precision.
#pragma once

#include <array>
#include <cstdint>

#include "base/few_of.h"
#include "base/tolerances.h"
#include "carom/shapes/dop.h"
#include "shapes/turn.h"

namespace carom {

// The slabs of a k-DOP, in any unit of length.
struct DopSlabs {
  DopKind kind = DopKind::k6;
  std::array<double, kMostSlabs> lower{};
  std::array<double, kMostSlabs> upper{};

  DopSlabs() = default;
  explicit DopSlabs(const Dop& dop);

  // Narrows the first three slabs to what pairs of the others imply. It is the same set of points,
  // but the three are then a good bound of it even if they were far off.
  DopSlabs with_tight_axes() const;
  // The greatest absolute coordinate in the first three slabs.
  double size() const;
};

// Plane 2 i is the upper plane of slab i, plane 2 i + 1 its lower one.
constexpr size_t slab_of_plane(size_t plane) { return plane / 2; }
constexpr int sign_of_plane(size_t plane) { return plane % 2 == 0 ? 1 : -1; }

struct DopCorner {
  Double3 point;
  uint8_t edge;  // the other plane of the edge from here to the next corner
};

// The part of a plane that belongs to the polytope, counter-clockwise seen from outside. A plane
// that only touches the polytope has one corner or two.
struct DopFace {
  // Four of a rectangle, and one more for every plane that cuts it.
  static constexpr size_t kMostCorners = 4 + 2 * kMostSlabs;

  uint8_t plane;
  FewOf<DopCorner, kMostCorners> corners;
};

struct DopEdge {
  Double3 start;
  std::array<uint8_t, 2> planes;
};

// Slabs may be redundant or flat, and the polytope may have no area or no length. The ends of slabs
// were rounded to floats: if no point is left, the constructor tries again with slabs half a unit
// wider.
class DopPolytope {
 public:
  // 26 faces have at most 72 edges and 48 corners (Euler). Planes that coincide add edges; there is
  // room to spare.
  static constexpr size_t kMostPoints = 96;
  static constexpr size_t kMostEdges = 288;

  explicit DopPolytope(const DopSlabs& slabs);

  bool is_empty() const { return points_.empty(); }
  const FewOf<Double3, kMostPoints>& points() const { return points_; }
  const FewOf<DopEdge, kMostEdges>& edges() const { return edges_; }
  const FewOf<DopFace, 2 * kMostSlabs>& faces() const { return faces_; }

 private:
  void build(const DopSlabs& slabs);
  void add_points(double tolerance);
  void add_edges();

  FewOf<DopFace, 2 * kMostSlabs> faces_;
  FewOf<Double3, kMostPoints> points_;
  FewOf<DopEdge, kMostEdges> edges_;
};

constexpr bool is_dop_kind(DopKind kind) {
  return kind == DopKind::k6 || kind == DopKind::k14 || kind == DopKind::k18 ||
         kind == DopKind::k26;
}

// Whether slabs that are finite and in order have a point in common. For most the middle decides.
bool has_points(const Dop& dop);

}  // namespace carom
