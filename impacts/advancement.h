// When two convex shapes that move and turn meet: conservative advancement. Along a fixed direction
// the gap between the shapes' furthest points is never more than their distance; as long as it is
// proven to be positive, they do not touch. From the direction in which they are nearest at a time
// the search goes on to where the gap along it closes, and there asks for the direction again.
//
// Sources: B. Mirtich, "Timewarp Rigid Body Simulation", SIGGRAPH 2000, for advancement by a bound
// of the motion along the direction; E. Catto, "Continuous Collision", GDC 2013, for going to the
// root of the gap along a fixed direction. What makes the latter conservative is a bound of second
// derivatives: over a time s a function lies no more than M s^2 / 8 below its chord.
#pragma once

#include <algorithm>
#include <cmath>

#include "carom/results/contact.h"
#include "impacts/linear/crossing_scalar.h"
#include "impacts/turning.h"
#include "narrowphase/doubles/gjk.h"
#include "narrowphase/doubles/make_core.h"

namespace carom::scalar {

// A core that moves: its points at time t are turned by t * rotation, then moved. `arm`, too, is
// turned, from where the body turns to where the core is; the core itself only if `turns`.
struct MovingCore {
  const Core* core = nullptr;
  Vector3d arm = Vector3d::Zero();
  Vector3d rotation = Vector3d::Zero();
  bool turns = true;
  double speed = 0;   // of turning, radians
  double reach = 0;   // from where the body turns the furthest point that turns
  double extent = 0;  // and the furthest of all

  // World axes at time t.
  Rotation<double> turn(double t) const {
    if (!(speed > 0)) return {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
    return rotation_of(turn_by(rotation, t));
  }
};

inline constexpr double kSpeedUpwards = 1 + 0x1p-40;  // more than lengths round

inline MovingCore moving_core(const Core& core, const Vector3d& arm, const Vector3d& rotation,
                              bool turns) {
  double greatest = 0;
  for (size_t i = 0; i < core.size(); ++i) {
    const CoreVector p = core.point(i);
    greatest = max(greatest, dot(p, p));
  }
  const double size = std::sqrt(greatest), arm_length = std::sqrt(dot(arm, arm));
  const double reach = (turns ? size : 0.0) + arm_length;
  const bool is_round_about_pivot = !(reach > 0);
  const Vector3d turning = is_round_about_pivot ? Vector3d(Vector3d::Zero()) : rotation;
  return {&core,
          arm,
          turning,
          turns,
          angle_of(turning) * kSpeedUpwards,
          reach * kSpeedUpwards,
          (size + arm_length) * kSpeedUpwards};
}

// The plane of a half-space as one of its points: it turns even if that is where it turns about.
inline MovingCore turning_plane(const Core& point, const Vector3d& rotation) {
  MovingCore plane = moving_core(point, Vector3d::Zero(), rotation, true);
  plane.rotation = rotation;
  plane.speed = angle_of(rotation) * kSpeedUpwards;
  return plane;
}

// Two moving cores, B at `from` + t * `way`.
struct MovingPair {
  MovingCore a, b;
  Vector3d from, way;
  double radii = 0;
  FurthestPoint furthest = nullptr;
};

// What a moving core reaches along a direction.
struct MovingSupport {
  double height;
  double rate;     // of the furthest point
  Vector3d point;  // it, from where the body turns

  MovingSupport(const MovingCore& moving, const Rotation<double>& turn, const Vector3d& n,
                FurthestPoint furthest) {
    const Vector3d own = moving.turns ? rotate_back(turn, n) : n;
    const Vector3d corner =
        eigen_vector(moving.core->point(furthest(*moving.core, core_vector(own))));
    const Vector3d arm = rotate(turn, moving.arm);
    const Vector3d turned = moving.turns ? Vector3d(rotate(turn, corner) + arm) : arm;
    point = moving.turns ? turned : Vector3d(corner + arm);
    height = dot(n, point);
    rate = dot(n, cross(moving.rotation, turned));
  }
};

// What a direction is fixed to: shapes that lie flat on each other keep a direction that turns with
// the one whose face it is.
enum class FixedTo { world, a, b };

// The gap along a direction from A to B, radii included, as a function of time.
class DirectionGap {
 public:
  // The direction is `n` at time t.
  DirectionGap(const MovingPair& pair, const Vector3d& n, double t, FixedTo fixed)
      : pair_(pair), fixed_(fixed), n_(n) {
    if (fixed == FixedTo::a) n_ = rotate_back(pair.a.turn(t), n);
    if (fixed == FixedTo::b) n_ = rotate_back(pair.b.turn(t), n);
    set_bounds(t);
  }

  struct Value {
    double gap, rate;
  };
  Value at(double t) const {
    const Rotation<double> turn_a = pair_.a.turn(t), turn_b = pair_.b.turn(t);
    const Vector3d n = fixed_ == FixedTo::world ? n_
                       : fixed_ == FixedTo::a   ? rotate(turn_a, n_)
                                                : rotate(turn_b, n_);
    const MovingSupport a(pair_.a, turn_a, n, pair_.furthest);
    const MovingSupport b(pair_.b, turn_b, -n, pair_.furthest);
    const Vector3d place = pair_.from + pair_.way * t;
    double rate = dot(n, pair_.way) - (a.rate + b.rate);
    if (fixed_ != FixedTo::world) {
      const Vector3d& turning = fixed_ == FixedTo::a ? pair_.a.rotation : pair_.b.rotation;
      rate += dot(cross(turning, n), Vector3d((place + b.point) - a.point));
    }
    return {(dot(n, place) - (a.height + b.height)) - pair_.radii, rate};
  }

  // Bounds from t on: of how fast the gap closes, and of second derivatives.
  double most_closing() const { return most_closing_; }
  double most_curved() const { return most_curved_; }

 private:
  static double length(const Vector3d& v) { return std::sqrt(dot(v, v)); }
  static double own_turning(const MovingCore& core, const Vector3d& n) {
    return length(cross(n, core.rotation)) * core.reach;
  }

  // The points of what the direction is fixed to do not move along it.
  void set_bounds(double t) {
    const MovingCore &a = pair_.a, &b = pair_.b;
    if (fixed_ == FixedTo::world) {
      most_closing_ = (own_turning(a, n_) + own_turning(b, n_)) - dot(n_, pair_.way);
      most_curved_ = a.speed * a.speed * a.reach + b.speed * b.speed * b.reach;
      return;
    }
    const MovingCore& frame = fixed_ == FixedTo::a ? a : b;
    const MovingCore& other = fixed_ == FixedTo::a ? b : a;
    const double start = length(pair_.from + pair_.way * t), end = length(pair_.from + pair_.way);
    const double furthest = max(start, end) + other.extent;
    const double fastest = length(pair_.way) + other.speed * other.reach;
    most_closing_ = frame.speed * furthest + fastest;
    most_curved_ = frame.speed * (frame.speed * furthest + 2 * fastest) +
                   other.speed * other.speed * other.reach;
  }

  const MovingPair& pair_;
  const FixedTo fixed_;
  Vector3d n_;  // in the frame of what it is fixed to
  double most_closing_ = 0, most_curved_ = 0;
};

// Whether a function with these values at both ends of a time s, and second derivatives of `curved`
// at most, stays above `least` between them.
inline bool stays_above(double first, double last, double curved, double s, double least) {
  const double sag = curved * s * s / 2;
  const double lowest_at = sag > 0 ? 0.5 + (first - last) / (2 * sag) : -1;
  if (lowest_at > 0 && lowest_at < 1) return first - sag * lowest_at * lowest_at >= least;
  return min(first, last) >= least;
}

inline constexpr double kBeyondEnd = 2;  // a time that is none
inline constexpr int kMostSteps = 2;     // along one direction; more led no further in most rounds
inline constexpr int kMostHalvings = 60;

// From a time t at which the gap is positive to one before which it is positive all along, and
// where it is about `tolerance`, or as far as a few steps lead; or beyond the end.
template <class Gap>
double advance(const Gap& gap, double t, double tolerance) {
  const double aim = tolerance / 2, least = tolerance / 4;
  auto now = gap.at(t);
  for (int step = 0; step < kMostSteps && now.gap > tolerance; ++step) {
    const double left = 1 - t, closing = gap.most_closing();
    const double sure = closing > 0 ? (now.gap - aim) / closing : kNever;
    if (sure >= left) return kBeyondEnd;
    double s = now.rate < 0 ? min((now.gap - aim) / -now.rate, left) : left;
    // Further the chord proves nothing, whatever the gap is there.
    if (gap.most_curved() > 0) s = min(s, std::sqrt(8 * now.gap / gap.most_curved()));
    auto then = now;
    for (int halving = 0;; ++halving) {
      if (s <= sure || halving == kMostHalvings) s = sure;
      then = gap.at(t + s);
      if (s <= sure || stays_above(now.gap, then.gap, gap.most_curved(), s, least)) break;
      // Gaps between corners are concave, mostly: they close behind where their chord does.
      const double chord = (now.gap - aim) / (now.gap - then.gap);
      const bool closes_late = halving == 0 && chord > 0.5 && chord < 1;
      s = max(s * (closes_late ? chord : 0.5), sure);
    }
    if (s >= left) return kBeyondEnd;
    if (!(t + s > t)) break;  // no further in double precision
    t += s;
    now = then;
  }
  return t;
}

struct AdvancementResult {
  double t;
  Status status = Status::ok;
};

// The cores as they are at a time, for the search of their distance.
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
  placed.middle = core_vector(moved(eigen_vector(moving.core->middle)));
}

// Memory for the cores of one pair, used again for the next.
struct CoreScratch {
  Core a, b, placed_a, placed_b;
};

inline CoreScratch& core_scratch_of_thread() {
  thread_local CoreScratch scratch;
  return scratch;
}

// From t on along the direction; with `spinning` ones that turn with either body are tried as well,
// and the one that leads furthest counts.
inline double advance_along(const MovingPair& pair, const Vector3d& n, double t, double tolerance,
                            bool spinning) {
  double next = advance(DirectionGap(pair, n, t, FixedTo::world), t, tolerance);
  if (spinning && pair.a.speed > 0 && next <= 1) {
    next = max(next, advance(DirectionGap(pair, n, t, FixedTo::a), t, tolerance));
  }
  if (spinning && pair.b.speed > 0 && next <= 1) {
    next = max(next, advance(DirectionGap(pair, n, t, FixedTo::b), t, tolerance));
  }
  return next;
}

inline constexpr int kMostRounds =
    256;  // grazing halves the gap at each; most pairs need one to five
inline constexpr int kEasyRounds = 6;  // most have met by then: spinning directions cost more

// The unit vector along which the cores are nearest. Of a way to the inside of an edge what
// rounding has left along that edge is taken out: of cores that all but touch it is most of what is
// wrong, and the gap along the edge's ends would be none.
inline Vector3d direction_of(const NearestWay& nearest) {
  Vector3d way = eigen_vector(nearest.way);
  if (nearest.corners.size() == 2) {
    const Vector3d edge = eigen_vector(nearest.corners[1] - nearest.corners[0]);
    way -= edge * (dot(way, edge) / dot(edge, edge));
  }
  return way / std::sqrt(dot(way, way));
}

// When the balls meet in which the cores turn; they do not before. (A third of all rounds is
// saved.)
inline double time_of_balls(const MovingPair& pair, double tolerance) {
  const double reach = (pair.a.extent + pair.b.extent) + (pair.radii + tolerance);
  return meets_ball(MovingPoint(pair.from, pair.way), reach);
}

// `tolerance`: the distance at which they have met.
inline AdvancementResult time_of_cores(const MovingPair& pair, double tolerance,
                                       CoreScratch& scratch) {
  double t = time_of_balls(pair, tolerance);
  if (t > 1) return {kNever};
  for (int round = 0; round < kMostRounds; ++round) {
    place(pair.a, Vector3d::Zero(), t, scratch.placed_a);
    place(pair.b, pair.from + pair.way * t, t, scratch.placed_b);
    const NearestWay nearest = nearest_way(scratch.placed_a, scratch.placed_b, pair.furthest);
    const double distance = std::sqrt(dot(nearest.way, nearest.way));
    const bool is_touching = nearest.corners.size() == 4 || distance <= kTouchingCores;
    if (is_touching || distance - pair.radii <= tolerance) return {t};
    const Vector3d n = direction_of(nearest);
    const double next = advance_along(pair, n, t, tolerance, round >= kEasyRounds);
    if (next > 1) return {kNever};
    if (next == t) return {t, distance - pair.radii <= 2 * tolerance ? Status::ok : Status::budget};
    t = next;
  }
  return {t, Status::budget};
}

// A is a half-space, as the one point of its plane that is furthest along the unit normal n: the
// direction is known, and turns with it.
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
