// The points, edges and faces of a k-DOP, in double precision.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

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
  uint8_t point;
  uint8_t edge;  // the other plane of the edge from here to the next corner
};

// The part of a plane that belongs to the polytope. A plane that only touches the polytope has one
// corner or two.
struct DopFace {
  // Four of a rectangle, and one more for every plane that cuts it.
  static constexpr size_t kMostCorners = 4 + 2 * kMostSlabs;

  uint8_t plane;
  uint16_t first, count;  // of its corners
};

struct DopEdge {
  uint8_t start;  // a point
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

  bool is_empty() const { return count_ == 0; }
  size_t point_count() const { return count_; }
  Double3 point(size_t i) const { return {column(0)[i], column(1)[i], column(2)[i]}; }
  // The x, y or z of all points. The last one is repeated up to a multiple of kPadding.
  static constexpr size_t kPadding = 8;
  const double* column(size_t axis) const { return lines_[axis * lines_of_column()].data(); }

  std::span<const DopEdge> edges() const { return edges_; }
  std::span<const DopFace> faces() const { return faces_; }
  // Counter-clockwise seen from outside.
  std::span<const DopCorner> corners(const DopFace& face) const {
    return std::span(corners_).subspan(face.first, face.count);
  }

  size_t bytes() const;

 private:
  void build(const DopSlabs& slabs);
  void add_edges();
  // A line of the cache, so that no vector lies in two.
  struct alignas(64) Line : std::array<double, kPadding> {};
  static_assert(sizeof(Line) == 64);
  size_t lines_of_column() const { return (count_ + kPadding - 1) / kPadding; }

  size_t count_ = 0;
  std::vector<Line> lines_;  // three columns
  std::vector<DopFace> faces_;
  std::vector<DopCorner> corners_;
  std::vector<DopEdge> edges_;
};

constexpr bool is_dop_kind(DopKind kind) {
  return kind == DopKind::k6 || kind == DopKind::k14 || kind == DopKind::k18 ||
         kind == DopKind::k26;
}

// Whether slabs that are finite and in order have a point in common. For most the middle decides.
bool has_points(const DopSlabs& slabs);

}  // namespace carom
