// The direction with the greatest gap between two convex shapes. The search tries all directions
// that can have it.
//
// The separation of convex shapes is the greatest gap between their projections over all
// directions: the distance of separate shapes, and minus the penetration depth of overlapping ones.
// One of a few directions attains it: normals of faces, common normals of edges and, for separate
// shapes, the directions from points to edges and to points.
//
// Sources: C. Ericson, Real-Time Collision Detection, 2005, section 5.2.1 (separating axes);
// S. Cameron and R. Culley, Determining the Minimum Translational Distance between Two Convex
// Polyhedra, ICRA 1986 (which directions suffice).
#pragma once

#include "base/tolerances.h"
#include "narrowphase/features/segment_scalar.h"
#include "narrowphase/scalar/polytope.h"

namespace carom::scalar {

// A direction from A to B, and the gap between the projections of the two cores.
struct Gap {
  double size = -HUGE_VAL;
  Vector3d normal;
  bool is_flat = false;  // there is no overlap along `normal`, in either order

  bool is_found() const { return size > -HUGE_VAL; }
};

class GapSearch {
 public:
  GapSearch(const Polytope& a, const Polytope& b)
      : a_(a),
        b_(b),
        has_rules_(a.rules.close_ways() || b.rules.close_ways()),
        between_(b.middle - a.middle),
        inner_radii_(a.inner_radius + b.inner_radius) {}

  // The greatest gap of all directions tried, and of those that the one-sided triangle rules of
  // both shapes allow.
  const Gap& greatest() const { return greatest_; }
  const Gap& greatest_allowed() const {
    return greatest_allowed_.is_found() ? greatest_allowed_ : greatest_;
  }

  // Tries the directions along which overlapping shapes can separate, from parts of A and B.
  void try_faces_and_edges(const Polytope& a, const Polytope& b) {
    for (const Vector3d& n : b.normals) try_both_ways(n);
    for (const Vector3d& n : a.normals) try_both_ways(n);
    for (const Vector3d& u : a.directions) {
      for (const Vector3d& v : b.directions) {
        const Vector3d n = cross(u, v);
        if (dot(n, n) > kParallelEdges) try_both_ways(unit_or_zero(n));
      }
    }
  }

  // Tries the other directions of the shortest vector between separate, touching or flat cores.
  void try_ways(const Polytope& a, const Polytope& b) {
    for (const Vector3d& p : a.points) {
      for (const PolytopeEdge& edge : b.edges) try_way(across(edge.start - p, edge.direction));
    }
    for (const Vector3d& p : b.points) {
      for (const PolytopeEdge& edge : a.edges) try_way(across(p - edge.start, edge.direction));
    }
    for (const Vector3d& p : a.points) {
      for (const Vector3d& q : b.points) try_way(q - p);
    }
    // For points or segments in one line, any perpendicular direction will do.
    for (const Polytope* shape : {&a, &b}) {
      for (const Vector3d& u : shape->directions) try_both_ways(any_perpendicular(u));
    }
    try_both_ways(Vector3d::UnitX());
  }

  void try_way(const Vector3d& way) { try_both_ways(unit_or_zero(way)); }

 private:
  static Vector3d across(const Vector3d& v, const Vector3d& u) {
    const Vector3d once = v - u * dot(v, u);
    return once - u * dot(once, u);
  }

  void try_both_ways(const Vector3d& n) {
    if (n.isZero(0) || cannot_be_greater(n)) return;
    const Range a = range_of(a_, n), b = range_of(b_, n);
    const double forwards = b.low - a.high, backwards = a.low - b.high;
    const bool is_flat = forwards >= -kTieOfGaps && backwards >= -kTieOfGaps;
    keep({forwards, n, is_flat});
    keep({backwards, -n, is_flat});
  }

  // The gap of the shapes is at most the gap of balls inside them.
  bool cannot_be_greater(const Vector3d& n) const {
    return !has_rules_ && std::fabs(dot(n, between_)) - inner_radii_ <= greatest_.size;
  }

  struct Range {
    double low, high;
  };
  static Range range_of(const Polytope& shape, const Vector3d& n) {
    Range range{HUGE_VAL, -HUGE_VAL};
    for (const Vector3d& p : shape.points) {
      const double height = dot(n, p);
      range = {min(range.low, height), max(range.high, height)};
    }
    return range;
  }

  void keep(const Gap& gap) {
    if (gap.size > greatest_.size + kTieOfGaps) greatest_ = gap;
    const bool is_allowed = gap.size > greatest_allowed_.size + kTieOfGaps &&
                            allows(a_.rules, gap.normal) && allows(b_.rules, -gap.normal);
    if (is_allowed) greatest_allowed_ = gap;
  }

  const Polytope& a_;
  const Polytope& b_;
  const bool has_rules_;
  const Vector3d between_;
  const double inner_radii_;
  Gap greatest_, greatest_allowed_;
};

}  // namespace carom::scalar
