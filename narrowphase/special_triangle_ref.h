// Triangles that are thick, one-sided or inside a mesh, against any convex shape, in double
// precision: pairs are rare, and tested one at a time.
//
// The separation of convex shapes is the greatest gap between their projections, over all
// directions: a distance if they are apart, the least way out if they overlap. It is attained in
// one of few directions: normals of faces, common normals of edges and, if the shapes are apart,
// the ways from points to edges and points. All of them are tried.
//
//   thickness    The shape is the prism between the triangle and its copy moved by the thickness
//                against the unit normal of the front.
//   one_sided    What comes from behind does not collide: if the middle of the other shape (of its
//                segment, box or corners) lies behind the triangle's back, the pair never touches:
//                its separation is infinite, its normal and points are not numbers. Half-spaces
//                have no middle: they come from behind if their normal looks to the front's side.
//                All others leave towards the front's side.
//   inner_edges  Nothing leaves over an inner edge, or over a corner between two of them: contacts
//                there have the normal of the face, and the separation is measured along it.
//
// Apart from what comes from behind, the last two change neither whether shapes overlap nor how far
// they are apart: they choose the way out of overlaps. Where no way is left they do not count. A
// triangle without area has no front, and none of the three.
//
// Sources: C. Ericson, Real-Time Collision Detection, 2005, section 5.2.1 (separating axes);
// S. Cameron and R. Culley, Determining the Minimum Translational Distance between Two Convex
// Polyhedra, ICRA 1986 (which directions suffice).
#pragma once

#include <limits>
#include <type_traits>

#include "narrowphase/halfspace_ref.h"
#include "narrowphase/polytope_ref.h"
#include "narrowphase/segment_ref.h"

namespace carom::reference {
namespace special {

// In scaled units: gaps closer than this are equal, so that the simplest direction is kept.
inline constexpr double kTie = 0x1p-48;
// In scaled units: points within this of a plane are in it.
inline constexpr double kInPlane = 0x1p-40;

inline bool comes_from_behind(const FrontRules& rules, const Vector3d& middle) {
  return rules.one_sided &&
         dot(rules.front, Vector3d(middle - rules.corner)) < -rules.thickness - kInPlane;
}

// The corners furthest along `way`, as bits.
inline unsigned corners_towards(const FrontRules& rules, const Vector3d& way) {
  const double height[] = {0, dot(way, rules.sides[0]), dot(way, rules.sides[1])};
  const double size = largest_component(rules.sides[0]) + largest_component(rules.sides[1]);
  const double least = max(max(height[0], height[1]), height[2]) - kInPlane * size;
  unsigned corners = 0;
  for (unsigned i = 0; i < 3; ++i) corners |= (height[i] >= least ? 1u : 0u) << i;
  return corners;
}

// Whether the other shape may leave this way.
inline bool allows(const FrontRules& rules, const Vector3d& way) {
  if (rules.one_sided && dot(rules.front, way) < -kInPlane) return false;
  if (rules.inner_edges == 0) return true;
  const auto is_inner = [&](unsigned edge) { return (rules.inner_edges >> edge % 3 & 1) != 0; };
  switch (corners_towards(rules, way)) {
    case 0b111:
      return true;
    case 0b011:
      return !is_inner(0);
    case 0b110:
      return !is_inner(1);
    case 0b101:
      return !is_inner(2);
    case 0b001:
      return !(is_inner(0) && is_inner(2));
    case 0b010:
      return !(is_inner(1) && is_inner(0));
    default:
      return !(is_inner(2) && is_inner(1));
  }
}

// A direction from A to B, and the gap between the projections of the two cores.
struct Gap {
  double size = -HUGE_VAL;
  Vector3d normal;
  bool is_flat = false;  // none of the two reaches into the other either way
};

class GapSearch {
 public:
  GapSearch(const Polytope& a, const Polytope& b) : a_(a), b_(b) {
    try_faces_and_edges();
    if (greatest_.size > -kInPlane || !is_found(greatest_)) try_ways();
  }

  // Of all, and of those that the rules of both leave.
  const Gap& greatest() const { return greatest_; }
  const Gap& greatest_allowed() const {
    return is_found(greatest_allowed_) ? greatest_allowed_ : greatest_;
  }

 private:
  static bool is_found(const Gap& gap) { return gap.size > -HUGE_VAL; }

  void try_faces_and_edges() {
    for (const Vector3d& n : b_.normals) try_both_ways(n);
    for (const Vector3d& n : a_.normals) try_both_ways(n);
    for (const Vector3d& u : a_.directions) {
      for (const Vector3d& v : b_.directions) {
        const Vector3d n = cross(u, v);
        if (dot(n, n) > 0x1p-50) try_both_ways(unit_or_zero(n));
      }
    }
  }

  // If cores are apart, or touch, or are flat.
  void try_ways() {
    for (const Vector3d& p : a_.points) {
      for (const PolytopeEdge& edge : b_.edges) try_way(across(edge.start - p, edge.direction));
    }
    for (const Vector3d& p : b_.points) {
      for (const PolytopeEdge& edge : a_.edges) try_way(across(p - edge.start, edge.direction));
    }
    for (const Vector3d& p : a_.points) {
      for (const Vector3d& q : b_.points) try_way(q - p);
    }
    // Points or segments in one line: any way across will do.
    for (const Polytope* shape : {&a_, &b_}) {
      for (const Vector3d& u : shape->directions) try_both_ways(any_perpendicular(u));
    }
    try_both_ways(Vector3d::UnitX());
  }

  static Vector3d across(const Vector3d& v, const Vector3d& u) {
    const Vector3d once = v - u * dot(v, u);
    return once - u * dot(once, u);
  }

  void try_way(const Vector3d& way) { try_both_ways(unit_or_zero(way)); }

  void try_both_ways(const Vector3d& n) {
    if (n.isZero(0)) return;
    const Range a = range_of(a_, n), b = range_of(b_, n);
    const double forwards = b.low - a.high, backwards = a.low - b.high;
    const bool is_flat = forwards >= -kTie && backwards >= -kTie;
    keep({forwards, n, is_flat});
    keep({backwards, -n, is_flat});
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
    if (gap.size > greatest_.size + kTie) greatest_ = gap;
    const bool is_allowed = gap.size > greatest_allowed_.size + kTie &&
                            allows(a_.rules, gap.normal) && allows(b_.rules, -gap.normal);
    if (is_allowed) greatest_allowed_ = gap;
  }

  const Polytope& a_;
  const Polytope& b_;
  Gap greatest_, greatest_allowed_;
};

// Of two flat convex sets that lie in planes across n, given by points: the middle of where they
// meet, seen along n, in the plane of the first. Of sets that do not meet, of the first's points
// that are nearest.
class Meeting {
 public:
  using Points = FewOf<Vector3d, 8>;

  Meeting(const Points& a, const Points& b, const Vector3d& n)
      : normal_(n), height_(dot(n, a[0])), a_(seen_along(a)), b_(seen_along(b)) {
    points_and_edges();
    points_and_areas();
    crossing_edges();
  }

  Vector3d point() const { return sum_ / count_ + normal_ * height_; }

 private:
  Points seen_along(const Points& points) const {
    Points seen;
    for (const Vector3d& p : points) seen.push_back(p - normal_ * dot(normal_, p));
    return seen;
  }

  // Diagonals count as edges.
  template <class Visit>
  static void for_each_edge(const Points& points, const Visit& visit) {
    for (size_t i = 0; i < points.size(); ++i) {
      for (size_t j = 0; j <= i; ++j) visit(points[i], points[j]);
    }
  }

  void points_and_edges() {
    for (const Vector3d& p : a_) {
      for_each_edge(b_, [&](const Vector3d& u, const Vector3d& v) {
        keep(p, nearest_on_segment(p, u, v).point);
      });
    }
    for (const Vector3d& p : b_) {
      for_each_edge(a_, [&](const Vector3d& u, const Vector3d& v) {
        keep(nearest_on_segment(p, u, v).point, p);
      });
    }
  }

  void points_and_areas() {
    for (const Vector3d& p : a_) {
      if (is_inside(p, b_)) keep(p, p);
    }
    for (const Vector3d& p : b_) {
      if (is_inside(p, a_)) keep(p, p);
    }
  }

  bool is_inside(const Vector3d& p, const Points& points) const {
    for (size_t i = 0; i < points.size(); ++i) {
      for (size_t j = 0; j < i; ++j) {
        for (size_t k = 0; k < j; ++k) {
          if (is_inside(p, points[i], points[j], points[k])) return true;
        }
      }
    }
    return false;
  }

  bool is_inside(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) const {
    const double x = turn(b - a, p - a), y = turn(c - b, p - b), z = turn(a - c, p - c);
    return (x > 0 && y > 0 && z > 0) || (x < 0 && y < 0 && z < 0);
  }

  void crossing_edges() {
    for_each_edge(a_, [&](const Vector3d& p, const Vector3d& q) {
      for_each_edge(b_, [&](const Vector3d& u, const Vector3d& v) {
        const double slope = turn(q - p, v - u);
        const double t = turn(u - p, v - u) / slope, s = turn(u - p, q - p) / slope;
        if (!(t > 0 && t < 1 && s > 0 && s < 1)) return;  // nor if they are parallel
        const Vector3d crossing = p + (q - p) * t;
        keep(crossing, crossing);
      });
    });
  }

  double turn(const Vector3d& u, const Vector3d& v) const { return dot(normal_, cross(u, v)); }

  void keep(const Vector3d& on_a, const Vector3d& on_b) {
    const Vector3d way = on_b - on_a;
    const double distance = std::sqrt(dot(way, way));
    if (distance > least_ + kInPlane) return;
    if (distance < least_ - kInPlane) {
      least_ = distance;
      sum_ = Vector3d::Zero();
      count_ = 0;
    }
    sum_ += on_a;
    count_ += 1;
  }

  Vector3d normal_;
  double height_;
  Points a_, b_;
  double least_ = HUGE_VAL;
  Vector3d sum_;
  double count_ = 0;
};

// The points furthest along n.
inline FewOf<Vector3d, 8> furthest(const Polytope& shape, const Vector3d& n) {
  double greatest = -HUGE_VAL;
  for (const Vector3d& p : shape.points) greatest = max(greatest, dot(n, p));
  FewOf<Vector3d, 8> points;
  for (const Vector3d& p : shape.points) {
    if (dot(n, p) >= greatest - kInPlane) points.push_back(p);
  }
  return points;
}

inline SeparationAs<double> never() {
  const Vector3d nan = Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  return {HUGE_VAL, nan, nan, nan};
}

inline SeparationAs<double> separation_of(const Polytope& a, Polytope b, const Vector3d& d) {
  b.move(d);
  if (comes_from_behind(a.rules, b.middle) || comes_from_behind(b.rules, a.middle)) return never();
  const GapSearch search(a, b);
  const bool overlap = search.greatest().size - (a.radius + b.radius) <= 0;
  const Gap& gap = overlap ? search.greatest_allowed() : search.greatest();
  const Vector3d& n = gap.normal;
  SeparationAs<double> result;
  result.separation = min(gap.size, search.greatest().size) - (a.radius + b.radius);
  result.normal = n;
  result.arm_a = Meeting(furthest(a, n), furthest(b, -n), n).point() + n * a.radius;
  result.arm_b = (result.arm_a + n * result.separation) - d;
  const bool is_convention = gap.is_flat && allows(a.rules, -n) && allows(b.rules, n);
  result.status = is_convention ? Status::degenerate : Status::ok;
  return result;
}

template <class A>
SeparationAs<double> separation_of(const A& a, const TriangleShape<double>& b,
                                   const PairPose<double>& pose) {
  return separation_of(polytope_of(a, pose.a), polytope_of(b, pose.b), pose.d);
}

// All that is known of a triangle, and where the other one is.
inline std::array<double, 19> numbers_of(const TriangleShape<double>& t,
                                         const Quaternion<double>& q, const Vector3d& d) {
  const auto& [a, b, c] = t.corners;
  return {a.x(),
          a.y(),
          a.z(),
          b.x(),
          b.y(),
          b.z(),
          c.x(),
          c.y(),
          c.z(),
          t.thickness,
          static_cast<double>(t.one_sided),
          static_cast<double>(t.inner_edges),
          q.v.x(),
          q.v.y(),
          q.v.z(),
          q.w,
          d.x(),
          d.y(),
          d.z()};
}

// In one order, whichever is asked for: the rules may turn a rounding into another way out.
inline SeparationAs<double> separation_of(const TriangleShape<double>& a,
                                          const TriangleShape<double>& b,
                                          const PairPose<double>& pose) {
  const bool in_order = numbers_of(a, pose.a, pose.d) <= numbers_of(b, pose.b, -pose.d);
  const Polytope core_a = polytope_of(a, pose.a), core_b = polytope_of(b, pose.b);
  return in_order ? separation_of(core_a, core_b, pose.d)
                  : flipped(separation_of(core_b, core_a, -pose.d));
}

inline SeparationAs<double> separation_of(const HalfspaceShape<double>& halfspace,
                                          const TriangleShape<double>& triangle,
                                          const PairPose<double>& pose) {
  const Polytope shape = polytope_of(triangle, pose.b);
  const Plane<double> plane = plane_of<double>(halfspace, pose.a, -pose.d);
  const bool from_behind = dot(shape.rules.front, plane.normal) > kInPlane;
  if (shape.rules.one_sided && from_behind) return never();
  return flipped(points_over_plane<double>(plane, shape.points, triangle.size(), -pose.d));
}

}  // namespace special

// A (a triangle may itself be special) against a special triangle, or a special triangle against a
// plain one. Nothing in float but that it is unsure.
template <class Real, class A>
SeparationAs<Real> special_triangle(const A& a, const TriangleShape<Real>& b,
                                    const PairPose<Real>& pose) {
  const Vector3<Real> zero = Vector3<Real>::Zero();
  if constexpr (std::is_same_v<Real, float>) {
    return {0, zero, zero, zero, Status::ok, true};
  } else {
    return special::separation_of(a, b, pose);
  }
}

}  // namespace carom::reference
