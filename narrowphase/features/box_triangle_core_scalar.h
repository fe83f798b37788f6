// Box against triangle, scalar form. The box is centred at the origin, along the coordinate axes.
#pragma once

#include <type_traits>

#include <array>
#include <utility>

#include "narrowphase/features/rounded_scalar.h"
#include "narrowphase/features/segment_box_scalar.h"
#include "narrowphase/scalar/scaled.h"
#include "narrowphase/scalar/shapes.h"

namespace carom::scalar {

// The triangle in the frame of the box; edge i leads from corner i to the next.
template <class Real>
struct PlacedTriangle {
  std::array<Vector3<Real>, 3> corners;
  std::array<Vector3<Real>, 3> edges;

  // Takes differences before it moves the corners: so short edges keep their direction.
  template <class Turn>
  PlacedTriangle(const TriangleShape<Real>& shape, const Vector3<Real>& position,
                 const Turn& turn) {
    for (int i = 0; i < 3; ++i) {
      edges[i] = turn(Vector3<Real>(shape.corners[(i + 1) % 3] - shape.corners[i]));
    }
    corners[0] = turn(shape.corners[0]) + position;
    corners[1] = corners[0] + edges[0];
    corners[2] = corners[0] - edges[2];
  }

  Interval<Real> extent(const Vector3<Real>& n) const {
    const Real a = dot(n, corners[0]), b = dot(n, corners[1]), c = dot(n, corners[2]);
    return {min(min(a, b), c), max(max(a, b), c)};
  }
};

// The normal of the plane, of any length and to either side; zero if the triangle is a segment.
// Computed from the shortest and the longest edge; it is perpendicular to the longest edge however
// thin the triangle is.
template <class Real>
Vector3<Real> plane_normal(const PlacedTriangle<Real>& triangle,
                           const std::array<DirectedSegment<Real>, 3>& edges) {
  Real size[3];
  for (int i = 0; i < 3; ++i) size[i] = largest_component(triangle.edges[i]);
  const int longest = size[0] >= size[1] && size[0] >= size[2] ? 0 : size[1] >= size[2] ? 1 : 2;
  const int next = (longest + 1) % 3, last = (longest + 2) % 3;
  const Vector3<Real>& base = edges[longest].direction;
  const Vector3<Real>& side = edges[size[next] <= size[last] ? next : last].direction;
  const Real squared = dot(base, base);
  const Real share = squared > 0 ? dot(side, base) / squared : 0;
  const Vector3<Real> height = side - base * share;
  return cross(base, Vector3<Real>(height * scale_of(largest_component(height)).down));
}

template <class Real>
BoxAxis<Real> separating_axis(const PlacedTriangle<Real>& triangle,
                              const std::array<DirectedSegment<Real>, 3>& edges,
                              const Vector3<Real>& normal, const Vector3<Real>& half) {
  const auto& [a, b, c] = triangle.corners;
  AxisSearch<Real> search(half, min(min(a, b), c), max(max(a, b), c));
  search.try_axis(normal, triangle.extent(normal));
  search.try_crosses(edges[0].direction, a, c);
  search.try_crosses(edges[1].direction, b, a);
  search.try_crosses(edges[2].direction, c, b);
  return search.best();
}

// The best pair of points so far. Of separate shapes, the nearest pair is the one along whose
// direction the gap equals the distance; this also decides between neighbouring features whose
// distances are equal up to rounding. Overlapping shapes, once moved out, touch at the pair with
// the least distance.
template <class Real>
struct NearestPair {
  Vector3<Real> point;  // on the triangle
  Vector3<Real> way;    // from the box
  Real certain;         // the gap along the direction
  Real rank;            // separate: certain - distance; overlapping: -distance; greatest is best
};

// The nearest points of an edge and the box.
template <class Real>
NearestPair<Real> pair_of_edge(const DirectedSegment<Real>& edge,
                               const PlacedTriangle<Real>& triangle, const Vector3<Real>& half,
                               bool overlap) {
  const NearestToBox<Real> nearest = nearest_to_box(edge, half);
  const Real squared = dot(nearest.way, nearest.way);
  const Real distance = std::sqrt(squared);
  const Vector3<Real> n = nearest.way * (distance > 0 ? 1 / distance : 0);
  const Real certain = triangle.extent(n).low - reach(half, n);
  return {nearest.point, nearest.way, certain, overlap ? -distance : certain - distance};
}

// Whether the corner of the box projects into the triangle along the normal of the plane.
template <class Real>
bool is_over(const Vector3<Real>& corner, const Vector3<Real>& normal,
             const PlacedTriangle<Real>& triangle,
             const std::array<DirectedSegment<Real>, 3>& edges) {
  Real side[3];
  for (int i = 0; i < 3; ++i) {
    side[i] = dot(cross(normal, edges[i].direction), Vector3<Real>(corner - triangle.corners[i]));
  }
  return min(min(side[0], side[1]), side[2]) >= 0 || max(max(side[0], side[1]), side[2]) <= 0;
}

// Tries the corner of the box that is nearest to the plane, if it projects into the triangle.
template <class Real>
void try_face(NearestPair<Real>& best, const Vector3<Real>& normal,
              const PlacedTriangle<Real>& triangle,
              const std::array<DirectedSegment<Real>, 3>& edges, const Vector3<Real>& half,
              bool overlap) {
  const Real squared = dot(normal, normal);
  const Real to_unit = squared > 0 ? 1 / std::sqrt(squared) : 0;
  const Real height = dot(normal, triangle.corners[0]);
  const Vector3<Real> n = normal * (height < 0 ? -to_unit : to_unit);  // towards the triangle
  Vector3<Real> corner;
  for (int i = 0; i < 3; ++i) corner[i] = n[i] < 0 ? -half[i] : half[i];
  const Real gap = triangle.extent(n).low - reach(half, n);
  const Real rank = overlap ? -std::fabs(gap) : gap - std::fabs(gap);
  if (squared > 0 && is_over(corner, n, triangle, edges) && rank >= best.rank) {
    best = {corner + n * gap, n * gap, gap, rank};
  }
}

// Moves an overlapping triangle out of the box first; the nearest points are then the contact
// location.
template <class Real>
BoxContact<Real> box_triangle(PlacedTriangle<Real> triangle, const Vector3<Real>& half) {
  std::array<DirectedSegment<Real>, 3> edges = {
      DirectedSegment<Real>{triangle.corners[0], triangle.edges[0]},
      DirectedSegment<Real>{triangle.corners[1], triangle.edges[1]},
      DirectedSegment<Real>{triangle.corners[2], triangle.edges[2]}};
  const Vector3<Real> normal = plane_normal(triangle, edges);
  const BoxAxis<Real> axis = separating_axis(triangle, edges, normal, half);

  // The direction between points that nearly touch is only rounding. (In float such a pair is
  // unsure.)
  const bool overlap = axis.gap <= (std::is_same_v<Real, double> ? Real(0x1p-36) : Real(0));
  const Vector3<Real> inwards = axis.normal * min(axis.gap, Real(0));
  for (int i = 0; i < 3; ++i) {
    triangle.corners[i] -= inwards;
    edges[i].start = triangle.corners[i];
  }
  NearestPair<Real> best = pair_of_edge(edges[0], triangle, half, overlap);
  for (int i = 1; i < 3; ++i) {
    const NearestPair<Real> next = pair_of_edge(edges[i], triangle, half, overlap);
    if (next.rank > best.rank) best = next;
  }
  try_face(best, normal, triangle, edges, half, overlap);

  const CoreNormal<Real> core = core_normal(axis, best.way, best.certain);
  const Vector3<Real> on_box = best.point - beyond(best.point, half);
  return {core.distance, core.normal, on_box, best.point + inwards,
          core.is_unsure || is_near_touch(axis.gap)};
}

}  // namespace carom::scalar
