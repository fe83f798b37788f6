// The signed distance of two placed shapes by brute force: all pairs of features if they are
// separate, all axes of least penetration if they overlap. In long double by default; works in any
// real type.
#pragma once

#include <vector>

#include "oracle/convex_shape.h"

namespace carom::oracle {

template <class R = long double>
struct ConvexSeparation {
  R value;         // <= 0: overlap by that much
  Vec3<R> normal;  // unit, from A to B; the gap along it is the separation
};

// The directions that the search for the separation of two cores tries. They do not depend on where
// the cores are, so a caller that only moves the shapes computes them once.
template <class R>
class ConvexDirections {
 public:
  using Vec = Vec3<R>;

  ConvexDirections(const ConvexShape<R>& a, const ConvexShape<R>& b);

  // Unit vectors or zero: the normals of faces, and the common normals of edges.
  const std::vector<Vec>& axes() const { return axes_; }
  // For each edge direction of A and then of B: the coordinate axis that is furthest from it, made
  // perpendicular to it.
  const std::vector<Vec>& beside() const { return beside_; }
  // For each edge of A with each of B. Computed when it is first asked for, which is when the cores
  // are separate.
  const std::vector<Vec>& edge_normals(const ConvexShape<R>& a, const ConvexShape<R>& b) const;

 private:
  void add_cross(const Vec& u, const Vec& v, bool is_solid);

  std::vector<Vec> axes_, beside_;
  mutable std::vector<Vec> edge_normals_;
};

// Signed distance with the normal that attains it; any one of them on a tie. For half-spaces that
// cross it is -infinity.
template <class R>
ConvexSeparation<R> separation_with_normal(const ConvexShape<R>& a, const ConvexShape<R>& b);

// The same for shapes that were moved, but not turned, since `directions` was computed.
template <class R>
ConvexSeparation<R> separation_with_normal(const ConvexShape<R>& a, const ConvexShape<R>& b,
                                           const ConvexDirections<R>& directions);

// The largest gap between the projections of the two cores, over all axes that can separate them.
template <class R>
R widest_gap(const ConvexShape<R>& a, const ConvexShape<R>& b);

template <class R>
R exact_separation(const ConvexShape<R>& a, const ConvexShape<R>& b) {
  return separation_with_normal(a, b).value;
}

// The gap between the projections on n, which points from A to B and need not be a unit vector. It
// never exceeds the separation, and equals it for the true normal. Half-spaces have unbounded
// projections; for them it is how far B must move against n to touch, or the separation projected
// on n if they are separate.
template <class R>
R gap_along(const ConvexShape<R>& a, const ConvexShape<R>& b, const Vec3<R>& n);

// Distance of a point from the surface; negative inside.
template <class R>
R signed_distance(const ConvexShape<R>& shape, const Vec3<R>& point) {
  return exact_separation(shape, ConvexShape<R>(point));
}

// Distance of a point from the surface, positive on both sides. For a flat shape: distance from the
// shape.
template <class R>
R surface_distance(const ConvexShape<R>& shape, const Vec3<R>& point);

// Two stored bodies in coordinates relative to the position of A.
template <class R = long double>
struct ConvexOracle {
  ConvexShape<R> a;
  ConvexShape<R> b;

  ConvexOracle(const Shape& shape_a, const Pose& pose_a, const Shape& shape_b, const Pose& pose_b)
      : a(shape_a, pose_a, pose_a.position), b(shape_b, pose_b, pose_a.position) {}

  ConvexSeparation<R> separation() const { return separation_with_normal(a, b); }
  // Mean of the bounding radii.
  R scale() const { return (a.bounding_radius + b.bounding_radius) / 2; }
  R gap_along(const Vec3<R>& n) const { return oracle::gap_along(a, b, n); }
};

}  // namespace carom::oracle
