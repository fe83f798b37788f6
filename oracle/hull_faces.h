// The faces of the convex hull of a few points, by trying every three of them. Coplanar and
// collinear points are found exactly. It shares only the exact numbers (Dyadic) with the library.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/dyadic.h"
#include "carom/shapes/hull.h"

namespace carom::oracle {

// Points must be finite. O(n^4) at worst, about n^3 if most points are corners.
class HullFaces {
 public:
  using Outline = std::vector<uint32_t>;

  explicit HullFaces(std::span<const Eigen::Vector3f> points);

  // 0: a point, 1: a segment, 2: a flat polygon, 3: a solid.
  int dimension() const { return dimension_; }
  // Indices of corners, each distinct point once; ascending except for the ends of a segment.
  const std::vector<uint32_t>& corners() const { return corners_; }
  // Outlines of the faces, counter-clockwise as seen from outside. A polygon has two.
  const std::vector<Outline>& faces() const { return faces_; }

 private:
  void find();

  // Indices of distinct points in the order of their coordinates.
  std::vector<uint32_t> distinct() const;

  // The first three points that are not collinear; otherwise the ends of the line.
  Outline find_plane(const std::vector<uint32_t>& all) const;

  bool is_flat(const std::vector<uint32_t>& all, const Outline& plane) const;

  void find_faces(const std::vector<uint32_t>& all);

  struct Sides {
    std::vector<uint32_t> on;
    bool front = false, back = false;
    // The last points that lay on the two sides of a plane.
    uint32_t last_front = 0, last_back = 0;
  };

  // Stops as soon as points lie on both sides: the plane is no face. `found` is passed from plane
  // to plane: the next one often separates the same two points.
  void find_sides(const std::vector<uint32_t>& all, const std::array<uint32_t, 3>& plane,
                  Sides& found) const;

  // The outline of coplanar points in the orientation of the three points `plane`, seen along an
  // axis. A. M. Andrew, "Another efficient algorithm for convex hulls in two dimensions",
  // Information Processing Letters 9 (1979).
  Outline outline(std::vector<uint32_t> on, const Outline& plane) const;

  // The corners of half the outline, without the last one.
  Outline chain(const std::vector<uint32_t>& on, int axis) const;

  bool are_collinear(uint32_t i, uint32_t j, uint32_t k) const;

  // Orientation of three points seen along an axis: 1 counter-clockwise, -1 clockwise, 0 collinear.
  int turn(uint32_t i, uint32_t j, uint32_t k, int axis) const;

  template <class R>
  using Triple = std::array<R, 3>;

  // The plane through three points.
  class Plane {
   public:
    Plane(const HullFaces& hull, const std::array<uint32_t, 3>& corners);

    // The side of a point: 1 where the three appear counter-clockwise, -1 on the other side, 0 on
    // the plane.
    int side(uint32_t i) const;

   private:
    int exact_side(uint32_t i) const;

    const HullFaces& hull_;
    std::array<uint32_t, 3> corners_;
    Triple<double> origin_, normal_, size_;
  };

  template <class R>
  Triple<R> way(uint32_t from, uint32_t to) const {
    const Eigen::Vector3f &p = points_[from], &q = points_[to];
    return {R(q.x()) - R(p.x()), R(q.y()) - R(p.y()), R(q.z()) - R(p.z())};
  }

  // A bound of several roundings of double. Products of three floats neither overflow nor vanish.
  static constexpr double kRounding = 0x1p-48;

  std::span<const Eigen::Vector3f> points_;  // while the faces are found
  int dimension_ = 0;
  std::vector<uint32_t> corners_;
  std::vector<Outline> faces_;
};

// The hull of finite points. It keeps all of them, also inner and equal ones.
Hull hull_of(const std::vector<Eigen::Vector3f>& points);

// The faces of the points of a hull. Those of hulls seen lately are not computed again.
std::shared_ptr<const HullFaces> faces_of(const std::shared_ptr<const HullGeometry>& geometry);

}  // namespace carom::oracle
