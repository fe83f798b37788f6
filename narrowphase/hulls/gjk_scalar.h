// GJK in float32 and scaled units. It gives sure distances and sure decisions; searches in double
// precision settle all other rows. The kernels in lanes do the same, operation for operation.
//
// Sources: see narrowphase/doubles/gjk.h.
#pragma once

#include <cmath>

#include "base/few_of.h"
#include "base/tolerances.h"
#include "narrowphase/doubles/convex.h"
#include "narrowphase/hulls/closest_feature_scalar.h"
#include "narrowphase/hulls/float_core.h"
#include "narrowphase/hulls/simplex_scalar.h"
#include "narrowphase/scalar/separation.h"

namespace carom::scalar {

inline Vector3f furthest_point(const FloatCore& core, const Vector3f& way) {
  Vector3f best = core.points[0];
  float most = dot(way, best);
  for (size_t i = 1; i < core.points.size(); ++i) {
    const float height = dot(way, core.points[i]);
    if (!(height > most)) continue;
    most = height;
    best = core.points[i];
  }
  return best;
}

inline Corner difference_corner(const FloatCore& a, const FloatCore& b, const Vector3f& way) {
  const Vector3f on_a = furthest_point(a, way);
  return {furthest_point(b, -way) - on_a, on_a};
}

struct Gjk {
  Vector3f way;  // from A to B
  float squared;
  Simplex ends;            // the corners that span `way`
  bool is_around = false;  // zero is surely inside B - A
  bool has_ended = false;
};

inline Gjk run_gjk(const FloatCore& a, const FloatCore& b) {
  const Corner first = difference_corner(a, b, b.middle - a.middle);
  Gjk gjk{first.point, dot(first.point, first.point), {{first, first, first}, {true}}};
  for (size_t round = 0; round < kMostLaneRounds; ++round) {
    if (!(gjk.squared > kNearCores * kNearCores)) return gjk;
    const Corner next = difference_corner(a, b, gjk.way);
    const float gap = dot(gjk.way, next.point);
    const bool is_shortest = gjk.squared - gap <= gjk.squared * kLeastProgress;
    const NearestOfCorners nearest(gjk.ends, next.point);
    gjk.is_around = nearest.is_sure_around;
    if (nearest.is_around) return gjk;
    gjk.has_ended = is_shortest || !(nearest.squared < gjk.squared);
    if (gjk.has_ended) return gjk;
    gjk.way = nearest.point;
    gjk.squared = nearest.squared;
    gjk.ends.is_used = nearest.is_kept;
    size_t place = 0;
    while (gjk.ends.is_used[place]) ++place;
    gjk.ends.corner[place] = next;
    gjk.ends.is_used[place] = true;
  }
  return gjk;
}

inline NearestCores nearest_cores(const FloatCore& a, const FloatCore& b, const Gjk& gjk) {
  FewOf<Corner, 3> ends;
  for (size_t i = 0; i < 3; ++i) {
    if (gjk.ends.is_used[i]) ends.push_back(gjk.ends.corner[i]);
  }
  const SpannedWay way(ends);
  return way.confirmed_by(count_facing(a, way.normal(), way.height_of_a()),
                          count_facing(b, -way.normal(), way.height_of_b()));
}

inline Separation separation_of(const NearestCores& nearest, float radius_a, float radius_b,
                                const Vector3f& d) {
  Separation result = not_in_float<float>();
  result.separation = nearest.distance - (radius_a + radius_b);
  result.is_unsure = !(nearest.is_sure && std::fabs(result.separation) > kSureGap);
  result.normal = nearest.normal;
  result.arm_a = nearest.on_a + nearest.normal * radius_a;
  result.arm_b = (result.arm_a + nearest.normal * result.separation) - d;
  return result;
}

// Whether float32 may decide at this scale. `up`: metres per unit.
inline bool is_usual_scale(double up) { return up >= 1 / kGreatestScale && up <= kGreatestScale; }

struct FloatTest {
  Separation separation;
  bool is_deep = false;  // the cores themselves surely overlap
};

// `up`: metres per unit.
inline FloatTest nearest_separation(const FloatCore& a, const FloatCore& b, const Vector3f& d,
                                    float up) {
  FloatTest test{not_in_float<float>()};
  if (!a.has_space || !b.has_space || !is_usual_scale(up)) return test;
  const Gjk gjk = run_gjk(a, b);
  test.is_deep = gjk.is_around;
  NearestCores nearest = nearest_cores(a, b, gjk);
  nearest.is_sure = nearest.is_sure && gjk.has_ended;
  test.separation = separation_of(nearest, a.radius, b.radius, d);
  return test;
}

}  // namespace carom::scalar
