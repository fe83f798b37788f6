// The nearest vector between the hulls of two cores, in double precision: GJK.
//
// Sources: E. G. Gilbert, D. W. Johnson, S. S. Keerthi, "A Fast Procedure for Computing the
// Distance between Complex Objects in Three-Dimensional Space", IEEE J. Robotics and Automation
// 4(2), 1988; C. Ericson, Real-Time Collision Detection, 2005, section 9.5.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/few_of.h"
#include "base/tolerances.h"
#include "narrowphase/doubles/core.h"
#include "narrowphase/doubles/plain_gjk.h"
#include "narrowphase/doubles/sliver_cross.h"

namespace carom {

// The point of a simplex that is nearest to zero, and the corners that span it. The last corner is
// always one of them: without it no point would be nearer than before.
class NearestPoint {
 public:
  using Corners = FewOf<CoreVector, 4>;

  explicit NearestPoint(const Corners& corners) : last_(corners[corners.size() - 1]) {
    const size_t others = corners.size() - 1;
    keep(last_, 0);
    for (size_t i = 0; i < others; ++i) try_segment(corners[i], 1u << i);
    for (size_t i = 1; i < others; ++i) {
      for (size_t j = 0; j < i; ++j) try_triangle(corners[i], corners[j], 1u << i | 1u << j);
    }
    if (others == 3) try_tetrahedron(corners[0], corners[1], corners[2]);
    for (size_t i = 0; i < others; ++i) {
      if (kept_ >> i & 1) corners_.push_back(corners[i]);
    }
    corners_.push_back(last_);
  }

  const CoreVector& point() const { return point_; }
  double squared() const { return squared_; }
  const Corners& corners() const { return corners_; }
  bool is_around_zero() const { return corners_.size() == 4; }
  // Whether corner i of those that were given, but the last, is one of them.
  bool spans(size_t i) const { return kept_ >> i & 1; }

 private:
  // `others`: bits of the corners that span the point besides the last one.
  void keep(const CoreVector& point, unsigned others) {
    const double squared = dot(point, point);
    if (!(squared < squared_)) return;
    squared_ = squared;
    point_ = point;
    kept_ = others;
  }

  void try_segment(const CoreVector& p, unsigned others) {
    const CoreVector side = p - last_;
    const double along = -dot(last_, side), length = dot(side, side);
    if (along > 0 && along < length) keep(last_ + side * (along / length), others);
  }

  // `sliver`: the triangle is nearly a line, and rounding may not be forgotten.
  struct Plane {
    CoreVector point, normal;
    bool sliver;
  };
  static Plane plane_from(const CoreVector& a, const CoreVector& b, const CoreVector& c) {
    const CoreVector u = b - a, v = c - a, n = cross(u, v);
    const bool sliver = is_of_sliver(n, u, v);
    return {a, sliver ? sliver_cross(u, v) : n, sliver};
  }
  // Rounding moves the plane of a sliver least near the corner from which it is computed, so start
  // at the corner nearest to zero.
  static Plane plane_of(const CoreVector& a, const CoreVector& b, const CoreVector& c) {
    const double of_a = dot(a, a), of_b = dot(b, b), of_c = dot(c, c);
    if (of_a <= of_b && of_a <= of_c) return plane_from(a, b, c);
    return of_b <= of_c ? plane_from(b, c, a) : plane_from(c, a, b);
  }

  void try_triangle(const CoreVector& p, const CoreVector& q, unsigned others) {
    const Plane plane = plane_of(last_, p, q);
    const CoreVector& n = plane.normal;
    const bool is_over = plane.sliver ? is_over_sliver(n, p, q)
                                      : dot(n, cross(p, q)) > 0 && dot(n, cross(q, last_)) > 0 &&
                                            dot(n, cross(last_, p)) > 0;
    if (is_over) keep(n * (dot(n, plane.point) / dot(n, n)), others);
  }
  bool is_over_sliver(const CoreVector& n, const CoreVector& p, const CoreVector& q) const {
    return dot(n, sliver_cross(p, q)) > 0 && dot(n, sliver_cross(q, last_)) > 0 &&
           dot(n, sliver_cross(last_, p)) > 0;
  }

  // Zero is inside if, for every face, it is on the same side as the fourth corner. Corners in one
  // plane count as outside, because rounding would decide for them.
  void try_tetrahedron(const CoreVector& p, const CoreVector& q, const CoreVector& r) {
    const bool is_inside = is_beside(p, q, r, last_) && is_beside(q, r, last_, p) &&
                           is_beside(r, last_, p, q) && is_beside(last_, p, q, r);
    if (is_inside) keep({0, 0, 0}, 0b111);
  }
  static bool is_beside(const CoreVector& a, const CoreVector& b, const CoreVector& c,
                        const CoreVector& fourth) {
    const Plane plane = plane_of(a, b, c);
    const CoreVector u = b - a, v = c - a, w = fourth - plane.point;
    const double volume = dot(plane.normal, w);
    if (!(std::fabs(volume) > kWithoutVolume * (size(u) * size(v) * size(w)))) return false;
    return volume * -dot(plane.normal, plane.point) > 0;
  }
  static double size(const CoreVector& v) {
    return std::max(std::max(std::fabs(v.x), std::fabs(v.y)), std::fabs(v.z));
  }

  CoreVector last_;
  double squared_ = HUGE_VAL;
  CoreVector point_{};
  unsigned kept_ = 0;
  Corners corners_;
};

inline bool are_same(const CoreVector& a, const CoreVector& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

inline bool holds(const NearestPoint::Corners& corners, const CoreVector& point) {
  return std::any_of(corners.begin(), corners.end(),
                     [&](const CoreVector& corner) { return are_same(corner, point); });
}

// The result of GJK. `way` leads from A to B. It is never shorter than the distance, and about zero
// if the cores touch or overlap.
struct NearestWay {
  CoreVector way;
  NearestPoint::Corners corners;  // of B - A, that span `way`; four: zero lies inside
  double gap = 0;  // between the projections on `way`, times its length; 0 if the cores touch
  NearestPoint::Corners of_a;  // the points of A at `corners`, if one of the cores is round
};

// Goes on from what plain GJK found.
inline NearestWay nearest_way(const Core& a, const Core& b, const scalar::PlainSimplex& plain,
                              FurthestPoint furthest) {
  constexpr int kMostRounds = 128;  // one or two are usual
  NearestPoint::Corners known;
  for (size_t i = 0; i < 3; ++i) {
    if (plain.used >> i & 1) known.push_back(plain.corner[i]);
  }
  NearestPoint nearest(known);
  for (int round = 0;; ++round) {
    const CoreVector& way = nearest.point();
    if (nearest.squared() <= kTouchingSquared || nearest.is_around_zero()) {
      return {way, nearest.corners(), 0, {}};
    }
    const CoreVector next = difference_point(a, b, way, furthest);
    const double gap = dot(way, next);
    // Search to the very last point, because `way` is only as good as the corners at its end.
    const bool has_ended = gap >= nearest.squared() || holds(nearest.corners(), next);
    if (has_ended || round == kMostRounds) return {way, nearest.corners(), gap, {}};
    NearestPoint::Corners corners = nearest.corners();
    corners.push_back(next);
    const NearestPoint nearer(corners);
    if (!(nearer.squared() < nearest.squared())) return {way, nearest.corners(), gap, {}};
    nearest = nearer;
  }
}

// Those of the points that span the nearest one.
inline NearestPoint::Corners spanning(const NearestPoint& nearest,
                                      const NearestPoint::Corners& points) {
  NearestPoint::Corners kept;
  for (size_t i = 0; i + 1 < points.size(); ++i) {
    if (nearest.spans(i)) kept.push_back(points[i]);
  }
  kept.push_back(points[points.size() - 1]);
  return kept;
}

// For round cores, which have no last point: ends where the gap shows the distance to be as good as
// known, and keeps the points of A.
inline NearestWay nearest_round_way(const Core& a, const Core& b, FurthestPoint furthest) {
  constexpr int kMostRounds = 128;  // ten are usual
  const DifferencePoint first = find_difference_point(a, b, b.middle - a.middle, furthest);
  const double size = a.reach_from_middle() + b.reach_from_middle();
  NearestPoint nearest({first.point});
  NearestPoint::Corners of_a = {first.of_a};
  for (int round = 0;; ++round) {
    const CoreVector& way = nearest.point();
    if (nearest.squared() <= kTouchingSquared || nearest.is_around_zero()) {
      return {way, nearest.corners(), 0, of_a};
    }
    const DifferencePoint next = find_difference_point(a, b, way, furthest);
    const double gap = dot(way, next.point), squared = nearest.squared();
    // How far the surface may be before the corners, times the distance: a share of the cores'
    // size, but less than what turns the way noticeably, and more than rounding.
    const double of_size = kSameRoundGap * size * std::sqrt(squared);
    const double slack = std::clamp(of_size, 0x1p-50 * squared, kSameRoundWay / 4 * squared);
    const bool has_ended = gap >= squared - slack || holds(nearest.corners(), next.point);
    if (has_ended || round == kMostRounds) return {way, nearest.corners(), gap, of_a};
    NearestPoint::Corners corners = nearest.corners();
    corners.push_back(next.point);
    const NearestPoint nearer(corners);
    if (!(nearer.squared() < nearest.squared())) return {way, nearest.corners(), gap, of_a};
    of_a.push_back(next.of_a);
    of_a = spanning(nearer, of_a);
    nearest = nearer;
  }
}

// The point of A that belongs to the nearest point of at most three corners. `of_a`: those of the
// corners that span it.
inline CoreVector spanned_of_a(const NearestPoint::Corners& corners, const CoreVector& nearest,
                               const NearestPoint::Corners& of_a) {
  if (corners.size() == 2) {
    const CoreVector side = corners[1] - corners[0];
    const double share = dot(nearest - corners[0], side) / dot(side, side);
    return of_a[0] + (of_a[1] - of_a[0]) * share;
  }
  if (corners.size() != 3) return of_a[0];
  const CoreVector u = corners[1] - corners[0], v = corners[2] - corners[0];
  const CoreVector n = cross(u, v), way = nearest - corners[0];
  const double squared = dot(n, n);
  if (!(squared > 0)) return of_a[0];
  const double of_u = std::clamp(dot(n, cross(way, v)) / squared, 0.0, 1.0);
  const double of_v = std::clamp(dot(n, cross(u, way)) / squared, 0.0, 1.0 - of_u);
  return of_a[0] + (of_a[1] - of_a[0]) * of_u + (of_a[2] - of_a[0]) * of_v;
}

inline NearestWay nearest_way(const Core& a, const Core& b, FurthestPoint furthest) {
  if (a.is_round() || b.is_round()) return nearest_round_way(a, b, furthest);
  return nearest_way(a, b, scalar::PlainGjk(a, b, furthest).simplex, furthest);
}

}  // namespace carom
