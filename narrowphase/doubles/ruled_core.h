// Hulls and round shapes against special triangles: thick, one-sided or inside a mesh
// (special_triangle.h has the rules). Double precision, one pair at a time, because such pairs are
// rare.
#pragma once

#include <array>

#include "narrowphase/doubles/convex.h"
#include "narrowphase/doubles/core_separation.h"
#include "narrowphase/scalar/rim.h"

namespace carom::scalar {

// The penetration direction with the least depth among those that faces and edges give and the
// rules of the triangle (B) allow.
class OpenWays {
 public:
  OpenWays(const Core& a, const Core& b, const FrontRules& rules, FurthestPoint furthest)
      : a_(a), b_(b), rules_(rules), furthest_(furthest) {}

  void try_both_ways(const Vector3d& n) {
    if (n.isZero(0)) return;
    keep(core_vector(n));
    keep(core_vector(-n));
  }

  // `otherwise` if the rules close all directions.
  CoreGap best_or(const CoreGap& otherwise) const {
    return best_.size > -HUGE_VAL ? best_ : otherwise;
  }

 private:
  void keep(const CoreVector& n) {
    const double of_b = least_height(b_, n);
    // Any point of A bounds the gap. That of the best direction so far rules most others out.
    if (of_b - dot(n, on_a_) <= best_.size + kTieOfGaps) return;
    if (!allows(rules_, -eigen_vector(n))) return;
    const CoreVector on_a = support_point(a_, n, furthest_);
    const double gap = of_b - dot(n, on_a);
    if (!(gap > best_.size + kTieOfGaps)) return;
    best_ = {.size = gap, .normal = n};
    on_a_ = on_a;
  }

  // The triangle has few points.
  static double least_height(const Core& core, const CoreVector& n) {
    double least = dot(n, core.point(0));
    for (size_t i = 1; i < core.size(); ++i) least = min(least, dot(n, core.point(i)));
    return least;
  }

  const Core& a_;
  const Core& b_;
  const FrontRules& rules_;
  const FurthestPoint furthest_;
  CoreGap best_{.size = -HUGE_VAL, .normal = {1, 0, 0}};
  CoreVector on_a_{0, 0, 0};  // A's furthest point along the normal of `best_`
};

// Tries the normals of all faces, and the cross products of the hull's and the triangle's edges.
inline void try_faces_and_edges(const HullShape<double>& hull, const Rotation<double>& turn,
                                const Polytope& triangle, OpenWays& ways) {
  const HullGeometry& geometry = *hull.geometry;
  const auto point = [&](uint32_t i) -> Vector3d {
    return rotate(turn, Vector3d(geometry.points()[i].cast<double>() * hull.scale));
  };
  const auto try_edge = [&](uint32_t i, uint32_t j) {
    const Vector3d u = unit_or_zero(point(j) - point(i));
    for (const Vector3d& v : triangle.directions) {
      const Vector3d n = cross(u, v);
      if (dot(n, n) > kParallelEdges) ways.try_both_ways(unit_or_zero(n));
    }
  };
  for (const Vector3d& n : triangle.normals) ways.try_both_ways(n);
  for (const HullGeometry::Face& face : geometry.faces()) {
    const auto corners = geometry.corners(face);
    Vector3d normal = Vector3d::Zero();
    for (size_t i = 2; i < corners.size(); ++i) {
      normal += cross(Vector3d(point(corners[i - 1]) - point(corners[0])),
                      Vector3d(point(corners[i]) - point(corners[0])));
    }
    ways.try_both_ways(unit_or_zero(normal));
    for (size_t i = 0; i < corners.size(); ++i) {
      const uint32_t from = corners[i], to = corners[(i + 1) % corners.size()];
      if (from < to) try_edge(from, to);  // the edge's other face has it in reverse
    }
  }
  if (geometry.faces().empty()) {
    for (uint32_t i = 1; i < geometry.points().size(); ++i) try_edge(0, i);
  }
}

// Rims and curved sides touch an edge of the triangle along any direction across it. So the best of
// these is found: first among a few, then around the best by halving steps.
class EdgeWays {
 public:
  EdgeWays(const Vector3d& edge, const Core& a, const Core& b, FurthestPoint furthest)
      : u_(any_perpendicular(edge)), v_(cross(edge, u_)), a_(a), b_(b), furthest_(furthest) {}

  void try_best(OpenWays& ways) const {
    std::array<double, kRimCorners> gap;
    for (size_t k = 0; k < kRimCorners; ++k) gap[k] = gap_along(way(k));
    for (size_t k = 0; k < kRimCorners; ++k) {
      const size_t last = (k + kRimCorners - 1) % kRimCorners, next = (k + 1) % kRimCorners;
      if (gap[k] >= gap[last] && gap[k] >= gap[next])
        ways.try_both_ways(best_between(last, k, next));
    }
  }

 private:
  Vector3d way(size_t k) const { return u_ * rim_cosine(k) + v_ * rim_sine(k); }

  double gap_along(const Vector3d& way) const {
    const CoreVector n = core_vector(way);
    return dot(n, support_point(b_, -n, furthest_)) - dot(n, support_point(a_, n, furthest_));
  }

  // Around a direction that is better than those on both sides of it.
  Vector3d best_between(size_t last, size_t here, size_t next) const {
    constexpr int kHalvings = 26;
    Vector3d left = way(last), middle = way(here), right = way(next);
    double best = gap_along(middle);
    for (int i = 0; i < kHalvings; ++i) {
      const Vector3d to_left = unit_or_zero(left + middle), to_right = unit_or_zero(middle + right);
      const double of_left = gap_along(to_left), of_right = gap_along(to_right);
      if (of_left > best && of_left >= of_right) {
        right = middle;
        middle = to_left;
        best = of_left;
      } else if (of_right > best) {
        left = middle;
        middle = to_right;
        best = of_right;
      } else {
        left = to_left;
        right = to_right;
      }
    }
    return middle;
  }

  const Vector3d u_, v_;
  const Core& a_;
  const Core& b_;
  const FurthestPoint furthest_;
};

// `try_ways` tries directions of A and the triangle, which is a core and a polytope.
template <class A, class TryWays>
SeparationAs<double> ruled_core(const A& a, const TriangleShape<double>& b,
                                const PairPose<double>& pose, const CoreTest& test,
                                const TryWays& try_ways) {
  Polytope triangle = polytope_of(b, pose.b);
  triangle.move(pose.d);
  CorePair& cores = core_pair_of_thread();
  make_core(a, pose.a, Vector3d::Zero(), cores.a);
  make_core_of_points(triangle.points, Vector3d::Zero(), cores.b);
  if (comes_from_behind(triangle.rules, eigen_vector(cores.a.middle))) return convex::never();
  CoreGap gap = find_gap(cores.a, cores.b, test);
  if (triangle.rules.close_ways() && gap.size - cores.a.radius <= 0) {
    OpenWays ways(cores.a, cores.b, triangle.rules, test.furthest);
    ways.try_both_ways(eigen_vector(gap.normal));
    try_ways(cores, triangle, ways);
    const double greatest = gap.size;
    gap = ways.best_or(gap);
    gap.size = min(gap.size, greatest);
  }
  return core_separation(cores.a, cores.b, gap, pose.d, test);
}

inline SeparationAs<double> ruled_hull(const HullShape<double>& a, const TriangleShape<double>& b,
                                       const PairPose<double>& pose, const CoreTest& test) {
  return ruled_core(a, b, pose, test,
                    [&](const CorePair&, const Polytope& triangle, OpenWays& ways) {
                      try_faces_and_edges(a, rotation_of(pose.a), triangle, ways);
                    });
}

template <RoundShape A>
SeparationAs<double> ruled_round(const A& a, const TriangleShape<double>& b,
                                 const PairPose<double>& pose, const CoreTest& test) {
  return ruled_core(a, b, pose, test,
                    [&](const CorePair& cores, const Polytope& triangle, OpenWays& ways) {
                      for (const Vector3d& n : triangle.normals) ways.try_both_ways(n);
                      for (const Vector3d& u : triangle.directions) {
                        if (u.isZero(0)) continue;
                        EdgeWays(u, cores.a, cores.b, test.furthest).try_best(ways);
                      }
                    });
}

}  // namespace carom::scalar
