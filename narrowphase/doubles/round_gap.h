// The gap between two cores of which one is round: distances by GJK, depths by the penetration
// search.
#pragma once

#include <algorithm>
#include <cmath>

#include "narrowphase/doubles/core_gap.h"
#include "narrowphase/doubles/penetration_search.h"
#include "narrowphase/doubles/round_gjk.h"

namespace carom::scalar {

// Where a depth is the least, or nearly, in a whole ring of directions, the polytope becomes full
// before it is near enough. From each direction that may still be better, this climbs to the
// greatest gap along the arc of its gradient, which leads across the ring.
class RingSearch {
 public:
  RingSearch(const Core& a, const Core& b, FurthestPoint furthest, WayOut& best)
      : a_(a), b_(b), furthest_(furthest), best_(best) {}

  void climb_from(const CoreVector& normal) {
    constexpr int kArcs = 3;
    CoreVector n = normal;
    for (int arc = 0; arc < kArcs; ++arc) {
      const CoreVector point = difference_point(a_, b_, n, furthest_);
      const CoreVector aside = point - n * dot(n, point);
      const double length = std::sqrt(dot(aside, aside));
      if (!(length > kSameRoundWayOut)) return;
      n = best_on_arc(n, aside * (1 / length));
    }
  }

  // Along the axes of a round core: where both cores share one, a cap may be as near as the ring,
  // and no arc leads to it.
  void try_axes_of(const Core& core) {
    if (!core.is_round()) return;
    const auto& [x, y, z] = core.roundness().axis;
    for (const CoreVector& across : {cross(x, y), cross(y, z), cross(z, x)}) {
      const double length = std::sqrt(dot(across, across));
      if (!(length > 0)) continue;  // one of them is flat
      const CoreVector n = across * (1 / length);
      keep_if_wider(n);
      keep_if_wider(-n);
    }
  }

 private:
  double gap_along(const CoreVector& n) const {
    return dot(n, difference_point(a_, b_, n, furthest_));
  }

  // Directions n + s * aside, by golden section in s (J. Kiefer, "Sequential Minimax Search for a
  // Maximum", Proc. AMS 4(3), 1953).
  CoreVector best_on_arc(const CoreVector& n, const CoreVector& aside) {
    constexpr double kGolden = 0x1.3c6ef372fe95p-1;
    constexpr int kRounds = 32;
    const auto way = [&](double s) {
      const CoreVector v = n + aside * s;
      return v * (1 / std::sqrt(dot(v, v)));
    };
    double low = 0, high = 0x1p-4;
    double inner = high - kGolden * high, outer = kGolden * high;
    double of_inner = gap_along(way(inner)), of_outer = gap_along(way(outer));
    for (int i = 0; i < kRounds; ++i) {
      if (of_inner > of_outer) {
        high = outer;
        outer = inner;
        of_outer = of_inner;
        inner = high - kGolden * (high - low);
        of_inner = gap_along(way(inner));
      } else {
        low = inner;
        inner = outer;
        of_inner = of_outer;
        outer = low + kGolden * (high - low);
        of_outer = gap_along(way(outer));
      }
    }
    const CoreVector found = way((low + high) / 2);
    keep_if_wider(found);
    return found;
  }

  void keep_if_wider(const CoreVector& n) {
    const double gap = gap_along(n);
    if (!(gap > best_.gap)) return;
    best_.gap = gap;
    best_.normal = n;
  }

  const Core& a_;
  const Core& b_;
  const FurthestPoint furthest_;
  WayOut& best_;
};

// The careful search for the depth starts from the corners around zero, or from where a careful
// search for the distance ends.
inline NearestWay start_of_round_depth(const Core& a, const Core& b, const RoundGjk& gjk,
                                       FurthestPoint furthest) {
  if (gjk.end != RoundGjk::End::around) return nearest_round_way(a, b, furthest);
  const auto& [p, q, r] = gjk.simplex.corner;
  const auto& [of_p, of_q, of_r] = gjk.of_a.corner;
  return {.way = {0, 0, 0},
          .corners = {p, q, r, gjk.last.point},
          .of_a = {of_p, of_q, of_r, gjk.last.of_a}};
}

// The way along which GJK finds the cores, grown by their radii, apart, if it leaves more.
inline void keep_parting_way(const Core& a, const Core& b, FurthestPoint furthest, WayOut& out) {
  const RoundGjk gjk(a, b, furthest, {.decides_separate = true});
  const double distance = std::sqrt(gjk.squared);
  if (gjk.end != RoundGjk::End::apart || !(gjk.gap / distance > out.gap)) return;
  out = {.normal = gjk.point * (1 / distance), .gap = gjk.gap / distance};
}

// One of the cores is round.
inline CoreGap find_round_gap(const Core& a, const Core& b, FurthestPoint furthest,
                              const RoundGoal& goal) {
  const RoundGjk gjk(a, b, furthest, goal);
  if (CoreGap gap; find_plain_round_gap(gjk, goal, gap)) return gap;
  const NearestWay nearest = start_of_round_depth(a, b, gjk, furthest);
  const double distance = std::sqrt(dot(nearest.way, nearest.way));
  const double parted = distance > kTouchingCores ? nearest.gap / distance : -HUGE_VAL;
  // Rounding may have ended GJK too early, at corners of nearly flat shapes.
  const double slack = std::min(kSameRoundWayOut, kSameRoundWay * distance);
  if (distance > kTouchingRound && distance - parted <= slack) {
    return {.size = distance,
            .normal = nearest.way * (1 / distance),
            .is_proven = distance <= gjk.radius || parted > gjk.radius + kProvenGap,
            .has_point = true,
            .of_a = spanned_of_a(nearest.corners, nearest.way, nearest.of_a)};
  }
  WayOutSearch search(a, b, furthest);
  WayOut out = search.run_round(nearest);
  if (!out.has_ended) {
    RingSearch ring(a, b, furthest, out);
    search.for_each_open_way([&](const CoreVector& normal) { ring.climb_from(normal); });
    ring.try_axes_of(a);
    ring.try_axes_of(b);
    out.has_ended = true;
  }
  // For a difference without volume, the penetration search tries only one direction.
  if (distance > kTouchingRound && parted > out.gap) {
    out = {.normal = nearest.way * (1 / distance), .gap = parted};
  }
  // A gap that GJK met on its way decides that shapes are apart that nearly touch.
  if (std::fabs(out.gap - gjk.radius) <= kTouchingWay) keep_parting_way(a, b, furthest, out);
  if (!out.has_point && nearest.corners.size() < 4 && distance - out.gap <= kTouchingWay) {
    out.has_point = true;
    out.of_a = spanned_of_a(nearest.corners, nearest.way, nearest.of_a);
  }
  return {.size = out.gap,
          .normal = out.normal,
          .is_flat = out.is_flat && !(out.gap > 0),
          .is_proven = std::fabs(out.gap) > kSameRoundWayOut,
          .has_ended = out.has_ended,
          .has_point = out.has_point,
          .of_a = out.of_a};
}

}  // namespace carom::scalar
