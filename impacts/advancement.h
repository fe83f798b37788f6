// The time of impact of two convex shapes that move and rotate, where the searches of approach.h
// and turning_approach.h leave it: conservative advancement. Along a fixed direction the gap
// between the shapes is never more than their distance. While the gap is proven positive, the
// shapes do not touch. From the direction of the nearest points at one time, the search goes to the
// time at which the gap along it closes, and finds the direction again there.
//
// Sources: B. Mirtich, "Timewarp Rigid Body Simulation", SIGGRAPH 2000, for advancement by a bound
// of the motion along the direction; E. Catto, "Continuous Collision", GDC 2013, for going to the
// root of the gap along a fixed direction. A bound of second derivatives makes the latter
// conservative: over a time s a function lies at most M s^2 / 8 below its chord.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/few_of.h"
#include "carom/results/contact.h"
#include "impacts/approach.h"
#include "impacts/direction_gap.h"
#include "impacts/linear/crossing_scalar.h"
#include "impacts/turning_approach.h"
#include "narrowphase/doubles/gjk.h"
#include "narrowphase/doubles/make_core.h"

namespace carom::scalar {

// Whether a function stays above `least` over a time s. `first` and `last` are its values at both
// ends; its second derivatives are at most `curved`.
inline bool stays_above(double first, double last, double curved, double s, double least) {
  const double sag = curved * s * s / 2;
  const double lowest_at = sag > 0 ? 0.5 + (first - last) / (2 * sag) : -1;
  if (lowest_at > 0 && lowest_at < 1) return first - sag * lowest_at * lowest_at >= least;
  return min(first, last) >= least;
}

inline constexpr double kBeyondEnd = 2;  // a time after the interval
inline constexpr int kMostSteps = 2;     // per direction; more steps rarely led further
inline constexpr int kMostHalvings = 60;

// Goes from a time t with a positive gap to a later time; the gap is positive all the way. Stops
// where the gap is about `tolerance`, or after kMostSteps steps. Returns kBeyondEnd if the gap
// never closes.
template <class Gap>
double advance(const Gap& gap, double t, double tolerance) {
  const double aim = tolerance / 2, least = tolerance / 4;
  auto now = gap.at(t);
  for (int step = 0; step < kMostSteps && now.gap > tolerance; ++step) {
    const double left = 1 - t, closing = gap.most_closing();
    const double sure = closing > 0 ? (now.gap - aim) / closing : kNever;
    if (sure >= left) return kBeyondEnd;
    double s = now.rate < 0 ? min((now.gap - aim) / -now.rate, left) : left;
    // Beyond this time the chord proves nothing, whatever the gap is there.
    if (gap.most_curved() > 0) s = min(s, std::sqrt(8 * now.gap / gap.most_curved()));
    auto then = now;
    for (int halving = 0;; ++halving) {
      if (s <= sure || halving == kMostHalvings) s = sure;
      then = gap.at(t + s);
      if (s <= sure || stays_above(now.gap, then.gap, gap.most_curved(), s, least)) break;
      // Gaps between corners are mostly concave, so they close later than their chord.
      const double chord = (now.gap - aim) / (now.gap - then.gap);
      const bool closes_late = halving == 0 && chord > 0.5 && chord < 1;
      s = max(s * (closes_late ? chord : 0.5), sure);
    }
    if (s >= left) return kBeyondEnd;
    if (!(t + s > t)) break;  // no progress in double precision
    t += s;
    now = then;
  }
  return t;
}

struct AdvancementResult {
  double t;
  Status status = Status::ok;
};

// Places the core at time t, for the search of the distance.
inline void place(const MovingCore& moving, const Vector3d& at, double t, Core& placed) {
  const Rotation<double> turn = moving.turn(t);
  const Vector3d offset = rotate(turn, moving.arm) + at;
  const auto moved = [&](const Vector3d& p) -> Vector3d {
    return (moving.turns ? rotate(turn, p) : p) + offset;
  };
  placed.resize(moving.core->size());
  for (size_t i = 0; i < moving.core->size(); ++i) {
    placed.set(i, core_vector(moved(eigen_vector(moving.core->point(i)))));
  }
  placed.pad();
  if (moving.core->is_round()) {
    CoreRoundness roundness = moving.core->roundness();
    for (CoreVector& axis : roundness.axis) {
      axis = core_vector(rotate(turn, eigen_vector(axis)));
    }
    placed.make_round(roundness);
  }
  placed.middle = core_vector(moved(eigen_vector(moving.core->middle)));
}

// The core of a body. The next pair uses it again if it has the same body at the same scale.
struct KeptCore {
  Core core;
  MovingCore moving;  // of `core`
  double scale = 0;   // 0: there is none
};

// The cores of one pair; the memory serves the next pair too.
struct CoreScratch {
  KeptCore a, b;
  Core placed_a, placed_b;

  void clear() { a.scale = b.scale = 0; }
};

inline CoreScratch& core_scratch_of_thread() {
  thread_local CoreScratch scratch;
  return scratch;
}

// The edge of a core at its furthest point along n: from there to the point to which the way falls
// least steeply. Zero for a core that is one point.
inline Vector3d edge_along(const Core& placed, const Vector3d& n, FurthestPoint furthest) {
  const Vector3d top = eigen_vector(support_point(placed, core_vector(n), furthest));
  Vector3d edge = Vector3d::Zero();
  double fall = 1, squared = 0;  // of the edge
  for (size_t i = 0; i < placed.size(); ++i) {
    const Vector3d side = eigen_vector(placed.point(i)) - top;
    const double its_fall = dot(n, side), its_squared = dot(side, side);
    if (!(its_fall * its_fall * squared < fall * fall * its_squared)) continue;
    edge = side;
    fall = its_fall;
    squared = its_squared;
  }
  return edge - n * dot(n, edge);
}

// The velocity at which n rotates if it stays perpendicular to an edge of each of two placed cores;
// zero if the edges are parallel, or if one of the two has none.
inline Vector3d spin_with_edges(const MovingPair& pair, const Vector3d& n, const Core& placed_a,
                                const Core& placed_b) {
  const Vector3d edge_a = edge_along(placed_a, n, pair.furthest);
  const Vector3d edge_b = edge_along(placed_b, -n, pair.furthest);
  const double area = dot(n, cross(edge_a, edge_b));
  const bool are_parallel =
      !(area * area > kParallelEdges * (dot(edge_a, edge_a) * dot(edge_b, edge_b)));
  if (are_parallel) return Vector3d::Zero();
  const double rise_a = dot(n, cross(pair.a.rotation, edge_a));
  const double rise_b = dot(n, cross(pair.b.rotation, edge_b));
  const Vector3d tilt = (cross(n, edge_b) * rise_a - cross(n, edge_a) * rise_b) / area;
  return cross(n, tilt);
}

// Advances from t along the direction n.
inline double advance_along(const MovingPair& pair, const Vector3d& n, double t, double tolerance) {
  return advance(DirectionGap(pair, n, t, FixedTo::world), t, tolerance);
}

// Also tries directions that rotate, and takes the one that leads furthest.
inline double advance_spinning(const MovingPair& pair, const Vector3d& n, double t,
                               double tolerance, const CoreScratch& scratch) {
  double next = advance_along(pair, n, t, tolerance);
  const auto try_gap = [&](const DirectionGap& gap) {
    if (next <= 1) next = max(next, advance(gap, t, tolerance));
  };
  if (pair.a.speed > 0) try_gap({pair, n, t, FixedTo::a});
  if (pair.b.speed > 0) try_gap({pair, n, t, FixedTo::b});
  const Vector3d spin = spin_with_edges(pair, n, scratch.placed_a, scratch.placed_b);
  if (!spin.isZero(0)) try_gap({pair, n, t, spin});
  return next;
}

inline constexpr int kMostRounds = 1024;  // grazing pairs halve the gap per round; most need 1 to 5
inline constexpr int kEasyRounds = 3;  // most pairs have met by then; spinning directions cost more

using FewEdges = FewOf<Vector3d, 2>;

// The unit vector next to `way` that is perpendicular to these edges; NaN if there is none.
inline Vector3d perpendicular(const Vector3d& way, const FewEdges& edges) {
  Vector3d n = way;
  if (edges.size() == 1) n -= edges[0] * (dot(way, edges[0]) / dot(edges[0], edges[0]));
  if (edges.size() == 2) n = cross(edges[0], edges[1]);
  if (dot(n, way) < 0) n = -n;
  return n / std::sqrt(dot(n, n));
}

// The unit vector between the nearest points. If it ends inside an edge, its part along that edge
// is rounding and is removed. For cores that nearly touch it is most of the error, and the gap at
// the ends of the edge would vanish.
inline Vector3d direction_of(const NearestWay& nearest) {
  FewEdges edges;
  if (nearest.corners.size() == 2) {
    edges.push_back(eigen_vector(nearest.corners[1] - nearest.corners[0]));
  }
  return perpendicular(eigen_vector(nearest.way), edges);
}

// GJK knows the distance of cores that nearly touch, but not the direction: turning it by 1e-6
// changes the length of a short vector by less than rounding, and still a corner far along a face
// closes the gap. This makes the direction perpendicular to the edges that lead to such corners, as
// far as it can, and returns the one with the widest gap.
inline Vector3d direction_past_corners(const CoreScratch& scratch, const NearestWay& nearest,
                                       FurthestPoint furthest) {
  constexpr int kMostTurns = 8;  // one or two are usual
  const Vector3d way = eigen_vector(nearest.way), corner = eigen_vector(nearest.corners[0]);
  FewEdges edges;
  for (size_t i = 1; i < nearest.corners.size(); ++i) {
    edges.push_back(eigen_vector(nearest.corners[i]) - corner);
  }
  Vector3d best = perpendicular(way, {}), n = perpendicular(way, edges);
  double widest = -HUGE_VAL;
  for (int turn = 0; turn < kMostTurns && dot(n, n) > 0; ++turn) {
    const Vector3d lowest = eigen_vector(
        difference_point(scratch.placed_a, scratch.placed_b, core_vector(n), furthest));
    const double gap = dot(n, lowest);
    if (gap > widest) best = n;
    widest = max(gap, widest);
    if (gap >= dot(n, corner) / 2) break;
    if (edges.is_full()) edges = {edges[1]};
    edges.push_back(lowest - corner);
    n = perpendicular(way, edges);
  }
  return best;
}

// The time at which the balls around the rotating cores meet; the cores cannot meet earlier. This
// saves a third of all rounds.
inline double time_of_balls(const MovingPair& pair, double tolerance) {
  const double reach = (pair.a.extent + pair.b.extent) + (pair.radii + tolerance);
  return meets_ball(MovingPoint(pair.from, pair.way), reach);
}

// `tolerance`: cores that are this close count as touching. A time after pair.latest is never.
inline AdvancementResult time_of_cores(const MovingPair& pair, double tolerance,
                                       CoreScratch& scratch) {
  double t = time_of_balls(pair, tolerance);
  if (t > pair.latest) return {kNever};
  if (!(pair.a.speed > 0) && !(pair.b.speed > 0)) {
    const Approach<PlainNearest> plain(pair, t, tolerance);
    // The margin that covers rounding may lead a little past the end.
    if (plain.time() > 1) return {kNever};
    if (plain.is_over()) return {plain.time()};
    const Approach<CarefulNearest> careful(pair, plain.time(), tolerance);
    t = careful.time();
    if (t > 1) return {kNever};
    if (careful.is_over()) return {t};
  } else {
    const TurningApproach approach(pair, t, tolerance);
    t = approach.time();
    if (approach.is_over()) return {t};
  }
  for (int round = 0; round < kMostRounds; ++round) {
    place(pair.a, Vector3d::Zero(), t, scratch.placed_a);
    place(pair.b, pair.from + pair.way * t, t, scratch.placed_b);
    const NearestWay nearest = nearest_way(scratch.placed_a, scratch.placed_b, pair.furthest);
    const double distance = std::sqrt(dot(nearest.way, nearest.way));
    const bool is_touching = nearest.corners.size() == 4 || distance <= kTouchingCores;
    if (is_touching || distance - pair.radii <= tolerance) return {t};
    const Vector3d n = direction_of(nearest);
    double next = round < kEasyRounds ? advance_along(pair, n, t, tolerance)
                                      : advance_spinning(pair, n, t, tolerance, scratch);
    if (next == t) {
      const Vector3d past = direction_past_corners(scratch, nearest, pair.furthest);
      next = advance_spinning(pair, past, t, tolerance, scratch);
    }
    if (next > pair.latest) return {kNever};
    if (next == t) return {t, distance - pair.radii <= 2 * tolerance ? Status::ok : Status::budget};
    t = next;
  }
  return {t, Status::budget};
}

// A is a half-space, given as the point of its plane that is furthest along the unit normal n. The
// direction is known and rotates with A.
inline AdvancementResult time_over_plane(const MovingPair& pair, const Vector3d& n,
                                         double tolerance) {
  const DirectionGap gap(pair, n, 0, FixedTo::a);
  double t = 0;
  for (int round = 0; round < kMostRounds; ++round) {
    if (gap.at(t).gap <= tolerance) return {t};
    const double next = advance(gap, t, tolerance);
    if (next > 1) return {kNever};
    if (next == t) break;
    t = next;
  }
  return {t, Status::budget};
}

}  // namespace carom::scalar
