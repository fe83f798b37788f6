// Any two convex shapes as cores, in double precision: distances by GJK, depths by the penetration
// search.
#pragma once

#include "narrowphase/doubles/convex.h"
#include "narrowphase/doubles/furthest_scalar.h"
#include "narrowphase/doubles/make_core.h"
#include "narrowphase/doubles/penetration_search.h"
#include "narrowphase/doubles/plain_gap.h"
#include "narrowphase/doubles/round_gap.h"
#include "narrowphase/features/contact_location.h"
#include "narrowphase/scalar/rim.h"
#include "narrowphase/scalar/separation.h"

namespace carom::scalar {

// Which function finds support points, and whether the caller wants the decision alone.
struct CoreTest {
  FurthestPoint furthest = &furthest_point;
  bool decides_only = false;
};

// The distance of zero from the faces of the tetrahedron; negative outside.
inline double depth_of_zero(const NearestPoint::Corners& y) {
  double least = HUGE_VAL;
  for (size_t i = 0; i < 4; ++i) {
    const CoreVector &apex = y[i], &a = y[(i + 1) % 4], &b = y[(i + 2) % 4], &c = y[(i + 3) % 4];
    const CoreVector n = cross(b - a, c - a);
    const double to_zero = -dot(n, a), to_apex = dot(n, apex - a);
    least = min(least, (to_apex < 0 ? -to_zero : to_zero) / std::sqrt(dot(n, n)));
  }
  return least;
}

// Three corners that are no sliver.
inline bool is_plain_face(const NearestPoint::Corners& corners) {
  if (corners.size() != 3) return false;
  const CoreVector u = corners[1] - corners[0], v = corners[2] - corners[0];
  return !is_of_sliver(cross(u, v), u, v);
}

inline CoreGap find_gap(const Core& a, const Core& b, const CoreTest& test) {
  if (a.is_round() || b.is_round()) {
    return find_round_gap(a, b, test.furthest, {test.decides_only, test.decides_only});
  }
  const FurthestPoint furthest = test.furthest;
  const PlainGjk plain(a, b, furthest);
  if (CoreGap gap; find_plain_gap(a, b, plain, furthest, test.decides_only, gap)) return gap;
  const NearestWay nearest = nearest_way(a, b, plain.simplex, furthest);
  if (test.decides_only && nearest.corners.size() == 4) {
    const double depth = depth_of_zero(nearest.corners);
    if (depth > kProvenGap) return {.size = -depth, .normal = {1, 0, 0}, .is_proven = true};
  }
  const double distance = std::sqrt(dot(nearest.way, nearest.way));
  const double parted = distance > kTouchingCores ? nearest.gap / distance : -HUGE_VAL;
  // Rounding may have ended GJK too early, at corners of nearly flat shapes.
  const bool is_distance = distance - parted <= kSameGap;
  if (is_distance && distance > kTouchingWay) {
    return {.size = distance,
            .normal = nearest.way * (1 / distance),
            .is_proven = true,
            .is_at_corners = distance > kFarFromTouching};
  }
  // The normal of a face of the difference is exact however near it is.
  if (is_distance && distance > kTouchingCores && is_plain_face(nearest.corners)) {
    return {
        .size = distance, .normal = nearest.way * (1 / distance), .is_proven = parted > kProvenGap};
  }
  WayOut out = WayOutSearch(a, b, furthest).run(nearest.corners);
  // For a difference without volume, the penetration search tries only one direction.
  if (parted - out.gap > kSameWayOut) {
    out = {.normal = nearest.way * (1 / distance), .gap = parted};
  }
  const bool is_close = out.gap <= 0 || distance - out.gap <= kTouchingWay;
  return {.size = is_distance ? distance : out.gap,
          .normal = out.normal,
          .is_flat = out.is_flat,
          .is_proven = std::fabs(out.gap) > kProvenGap,
          .has_ended = out.has_ended && is_close};
}

// The points of a core that reach `least` along n: every `step`-th of them. `count`: of all of
// them.
inline Meeting::Points points_from(const Core& core, const CoreVector& n, double least, size_t step,
                                   size_t& count) {
  Meeting::Points points;
  count = 0;
  for (size_t i = 0; i < core.size(); ++i) {
    if (!(dot(n, core.point(i)) >= least)) continue;
    if (count++ % step == 0 && !points.is_full()) points.push_back(eigen_vector(core.point(i)));
  }
  return points;
}

// The same of a round core. A disc that lies on the plane has many; each sixteenth of a turn is
// taken.
inline Meeting::Points furthest_round_points(const Core& core, const CoreVector& n, double slack) {
  const double least = dot(n, core.furthest_round(n)) - slack, reach = core.reach(n);
  Meeting::Points points;
  for (size_t i = 0; i < core.size(); ++i) {
    const double out = core.roundness().share[i] * reach;
    if (!(dot(n, core.point(i)) + out >= least)) continue;
    if (core.roundness().share[i] > 0 && dot(n, core.point(i)) - out >= least) {
      const auto& [x, y, z] = core.roundness().axis;  // the third is zero
      for (size_t k = 0; k < kRimCorners; ++k) {
        const CoreVector rim = x * rim_cosine(k) + y * rim_sine(k);
        points.push_back(eigen_vector(core.point(i) + rim * core.roundness().share[i]));
      }
    } else {
      points.push_back(eigen_vector(core.round_point(i, n)));
    }
  }
  return points;
}

// The furthest points of a core along n, up to a slack. If there are too many, an even sample of
// them.
inline Meeting::Points furthest_points(const Core& core, const CoreVector& n, double slack,
                                       FurthestPoint furthest) {
  if (core.is_round()) return furthest_round_points(core, n, slack);
  const double least = dot(n, core.point(furthest(core, n))) - slack;
  constexpr size_t kMost = Meeting::Points::kCapacity;
  size_t count;
  Meeting::Points points = points_from(core, n, least, 1, count);
  if (count > kMost) points = points_from(core, n, least, (count + kMost - 1) / kMost, count);
  return points;
}

// The crossing of two edges seen along n, as a point of the first. False if they do not cross well
// inside both, or are nearly parallel.
inline bool find_crossing(const Meeting::Points& a, const Meeting::Points& b, const Vector3d& n,
                          Vector3d& point) {
  const Vector3d u = a[1] - a[0], v = b[1] - b[0], between = b[0] - a[0];
  const double slope = dot(n, cross(u, v));
  const double t = dot(n, cross(between, v)) / slope, s = dot(n, cross(between, u)) / slope;
  if (!(t > kWellInside && t < 1 - kWellInside && s > kWellInside && s < 1 - kWellInside))
    return false;
  point = a[0] + u * t;
  return slope * slope > kParallelEdges * (dot(u, u) * dot(v, v));
}

// Whether the point lies well inside the triangle, seen along n.
inline bool is_over_triangle(const Vector3d& point, const Meeting::Points& triangle,
                             const Vector3d& n) {
  const Vector3d u = triangle[1] - triangle[0], v = triangle[2] - triangle[0];
  const Vector3d way = point - triangle[0];
  const double area = dot(n, cross(u, v));
  const double of_u = dot(n, cross(way, v)) / area, of_v = dot(n, cross(u, way)) / area;
  const bool is_inside = of_u > kWellInside && of_v > kWellInside && of_u + of_v < 1 - kWellInside;
  return is_inside && area * area > kParallelEdges * (dot(u, u) * dot(v, v));
}

// The contact location on A. The normal is rounded, most of all for shapes that are close. So the
// points that should face each other may miss the furthest height by a little, and the slack grows
// until they face each other.
inline Vector3d meeting_point(const Core& a, const Core& b, const CoreGap& gap,
                              FurthestPoint furthest) {
  if (gap.has_point) return eigen_vector(gap.of_a);
  if (a.size() == 1 && !a.is_round()) return eigen_vector(a.point(0));
  const Vector3d n = eigen_vector(gap.normal);
  Vector3d best;
  double least = HUGE_VAL;
  for (double slack = kInPlane; slack <= kMostSlack; slack *= 256) {
    // Most pairs touch at a corner, or where two edges cross.
    const Meeting::Points on_a = furthest_points(a, gap.normal, slack, furthest);
    if (gap.is_at_corners && on_a.size() == 1) return on_a[0];
    const Meeting::Points on_b = furthest_points(b, -gap.normal, slack, furthest);
    if (gap.is_at_corners && on_b.size() == 1) return on_b[0] - n * gap.size;
    if (on_a.size() == 2 && on_b.size() == 2 && find_crossing(on_a, on_b, n, best)) return best;
    if (on_a.size() == 1 && on_b.size() == 3 && is_over_triangle(on_a[0], on_b, n)) return on_a[0];
    if (on_a.size() == 3 && on_b.size() == 1 && is_over_triangle(on_b[0], on_a, n)) {
      return on_b[0] + n * dot(n, Vector3d(on_a[0] - on_b[0]));
    }
    const Meeting meeting(on_a, on_b, n);
    if (meeting.distance() < least) {
      least = meeting.distance();
      best = meeting.point();
    }
    if (least <= kFacing) break;
  }
  return best;
}

// `d` is the position of B relative to A, `on_a` the contact location on A without its radius.
inline SeparationAs<double> separation_at(const CoreGap& gap, const Vector3d& on_a, double radius_a,
                                          double radius_b, const Vector3d& d) {
  const Vector3d n = eigen_vector(gap.normal);
  SeparationAs<double> result;
  result.separation = gap.size - (radius_a + radius_b);
  result.normal = n;
  result.status = !gap.has_ended ? Status::budget : gap.is_flat ? Status::degenerate : Status::ok;
  result.is_unsure = !gap.is_proven || std::fabs(result.separation) <= kProvenGap;
  result.arm_a = on_a + n * radius_a;
  result.arm_b = (result.arm_a + n * result.separation) - d;
  return result;
}

// Without a location where the decision alone is wanted.
inline SeparationAs<double> core_separation(const Core& a, const Core& b, const CoreGap& gap,
                                            const Vector3d& d, const CoreTest& test) {
  const Vector3d on_a =
      test.decides_only ? Vector3d(Vector3d::Zero()) : meeting_point(a, b, gap, test.furthest);
  return separation_at(gap, on_a, a.radius, b.radius, d);
}

template <class A, class B>
SeparationAs<double> core_separation(const A& a, const B& b, const PairPose<double>& pose,
                                     const CoreTest& test) {
  CorePair& cores = core_pair_of_thread();
  make_core(a, pose.a, Vector3d::Zero(), cores.a);
  make_core(b, pose.b, pose.d, cores.b);
  const CoreGap gap = find_gap(cores.a, cores.b, test);
  return core_separation(cores.a, cores.b, gap, pose.d, test);
}

}  // namespace carom::scalar
