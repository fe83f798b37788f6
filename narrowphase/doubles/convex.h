// Any two convex shapes with a few flat faces, grown by radii, in double precision. It serves
// special triangles (special_triangle.h) and is clear rather than fast.
//
// For separate shapes, the nearest points show where to look; the answer is exactly one of the
// directions that the features there allow. Overlapping shapes separate along the normal of a face
// or across two edges.
#pragma once

#include <limits>
#include <type_traits>

#include "narrowphase/doubles/furthest_scalar.h"
#include "narrowphase/doubles/gap_search.h"
#include "narrowphase/doubles/gjk.h"
#include "narrowphase/doubles/make_core.h"
#include "narrowphase/features/contact_location.h"
#include "narrowphase/features/halfspace_scalar.h"

namespace carom::scalar {
namespace convex {

// The features of a shape that are furthest along n, where the angle of n may err by `angle`.
inline Polytope part_towards(const Polytope& shape, const Vector3d& n, double angle) {
  double most = -HUGE_VAL, size = 0;
  for (const Vector3d& p : shape.points) {
    most = max(most, dot(n, p));
    size = max(size, largest_component(Vector3d(p - shape.middle)));
  }
  const double least = most - (4 * size * angle + kTouchingCores);
  Polytope part;
  part.normals = shape.normals;
  for (const Vector3d& p : shape.points) {
    if (dot(n, p) >= least) part.points.push_back(p);
  }
  for (const PolytopeEdge& edge : shape.edges) {
    const double slope = std::fabs(dot(n, edge.direction));
    if (dot(n, edge.start) >= least && slope <= 4 * angle) part.edges.push_back(edge);
  }
  for (const PolytopeEdge& edge : part.edges) {
    if (!part.directions.is_full()) part.directions.push_back(edge.direction);
  }
  return part;
}

// The nearest vector, by the one GJK there is: over cores.
inline Vector3d nearest_vector(const Polytope& a, const Polytope& b) {
  CorePair& cores = core_pair_of_thread();
  make_core_of_points(a.points, Vector3d::Zero(), cores.a);
  make_core_of_points(b.points, Vector3d::Zero(), cores.b);
  return eigen_vector(nearest_way(cores.a, cores.b, &furthest_point).way);
}

// Finds the greatest gap of separate cores. False if the cores are not separate, or the features
// near the nearest points do not give the gap.
inline bool find_nearest(const Polytope& a, const Polytope& b, GapSearch& search) {
  const Vector3d way = nearest_vector(a, b);
  const double distance = std::sqrt(dot(way, way));
  if (!(distance > kTouchingCores)) return false;
  const Vector3d n = way / distance;
  const double angle = kWayTilt + kWayRounding / distance;
  const Polytope part_a = part_towards(a, n, angle), part_b = part_towards(b, -n, angle);
  search.try_faces_and_edges(part_a, part_b);
  search.try_ways(part_a, part_b);
  if (distance - search.greatest().size <= kSameDistance) return true;
  search.try_way(way);
  return distance - search.greatest().size <= kSameDistance;
}

// Tries all features. The gap of cores that are further apart than `least` may have any direction,
// so directions between points and edges are tried too.
inline void find_everything(const Polytope& a, const Polytope& b, double least, GapSearch& search) {
  search.try_faces_and_edges(a, b);
  if (search.greatest().size > least || !search.greatest().is_found()) search.try_ways(a, b);
}

inline Gap greatest_gap(const Polytope& a, const Polytope& b) {
  GapSearch search(a, b);
  if (!find_nearest(a, b, search)) find_everything(a, b, kTouchingCores, search);
  return search.greatest();
}

inline Gap greatest_allowed_gap(const Polytope& a, const Polytope& b) {
  GapSearch search(a, b);
  find_everything(a, b, -kInPlane, search);
  return search.greatest_allowed();
}

// The result for a shape that comes from behind a one-sided triangle.
inline SeparationAs<double> never() {
  const Vector3d nan = Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  return {HUGE_VAL, nan, nan, nan};
}

inline SeparationAs<double> separation_of(const Polytope& a, Polytope b, const Vector3d& d) {
  b.move(d);
  if (comes_from_behind(a.rules, b.middle) || comes_from_behind(b.rules, a.middle)) return never();
  Gap gap = greatest_gap(a, b);
  const double greatest = gap.size, radii = a.radius + b.radius;
  const bool has_rules = a.rules.close_ways() || b.rules.close_ways();
  if (has_rules && greatest - radii <= 0) gap = greatest_allowed_gap(a, b);
  const Vector3d& n = gap.normal;
  SeparationAs<double> result;
  result.separation = min(gap.size, greatest) - radii;
  result.normal = n;
  result.arm_a = Meeting(furthest(a, n), furthest(b, -n), n).point() + n * a.radius;
  result.arm_b = (result.arm_a + n * result.separation) - d;
  const bool is_convention = gap.is_flat && allows(a.rules, -n) && allows(b.rules, n);
  result.status = is_convention ? Status::degenerate : Status::ok;
  return result;
}

template <class A, class B>
SeparationAs<double> separation_of(const A& a, const B& b, const PairPose<double>& pose) {
  return separation_of(polytope_of(a, pose.a), polytope_of(b, pose.b), pose.d);
}

}  // namespace convex

// In float this test only reports that it is unsure.
template <class Real>
SeparationAs<Real> not_in_float() {
  const Vector3<Real> zero = Vector3<Real>::Zero();
  return {0, zero, zero, zero, Status::ok, true};
}

}  // namespace carom::scalar
