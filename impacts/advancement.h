// The time of impact of two convex shapes that move and rotate: conservative advancement. Along a
// fixed direction the gap between the shapes is never more than their distance. While the gap is
// proven positive, the shapes do not touch. From the direction of the nearest points at one time,
// the search goes to the time at which the gap along it closes, and finds the direction again
// there.
//
// Sources: B. Mirtich, "Timewarp Rigid Body Simulation", SIGGRAPH 2000, for advancement by a bound
// of the motion along the direction; E. Catto, "Continuous Collision", GDC 2013, for going to the
// root of the gap along a fixed direction. A bound of second derivatives makes the latter
// conservative: over a time s a function lies at most M s^2 / 8 below its chord.
#pragma once

#include <algorithm>
#include <cmath>

#include "carom/results/contact.h"
#include "impacts/linear/crossing_scalar.h"
#include "impacts/turning.h"
#include "narrowphase/doubles/gjk.h"
#include "narrowphase/doubles/make_core.h"

namespace carom::scalar {

// A moving core. At time t its points are rotated by t * rotation, then moved. `arm` leads from the
// pivot of the body to the core and always rotates; the core itself rotates only if `turns`.
struct MovingCore {
  const Core* core = nullptr;
  Vector3d arm = Vector3d::Zero();
  Vector3d rotation = Vector3d::Zero();
  bool turns = true;
  double speed = 0;   // of rotation, radians per interval
  double reach = 0;   // from the pivot to the furthest rotating point
  double extent = 0;  // from the pivot to the furthest point

  // The rotation from the start to time t.
  Rotation<double> turn(double t) const {
    if (!(speed > 0)) return {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
    return rotation_of(turn_by(rotation, t));
  }
};

inline constexpr double kSpeedUpwards = 1 + 0x1p-40;  // exceeds the rounding of lengths

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

// The plane of a half-space, as one of its points. It rotates even if that point is the pivot.
inline MovingCore turning_plane(const Core& point, const Vector3d& rotation) {
  MovingCore plane = moving_core(point, Vector3d::Zero(), rotation, true);
  plane.rotation = rotation;
  plane.speed = angle_of(rotation) * kSpeedUpwards;
  return plane;
}

// Two moving cores. B's position relative to A is `from` + t * `way`.
struct MovingPair {
  MovingCore a, b;
  Vector3d from, way;
  double radii = 0;
  FurthestPoint furthest = nullptr;
};

// The support point of a moving core along a direction.
struct MovingSupport {
  double height;
  double rate;     // of the support point along the direction
  Vector3d point;  // from the body's pivot

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

// What a direction is fixed to. A shape that lies flat on a face needs a direction that rotates
// with the face's body.
enum class FixedTo { world, a, b };

// The gap along a direction from A to B, minus the radii, as a function of time.
class DirectionGap {
 public:
  // The direction is `n` at time t, in world axes.
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

  // Bounds from t on: how fast the gap closes, and its second derivatives.
  double most_closing() const { return most_closing_; }
  double most_curved() const { return most_curved_; }

 private:
  static double length(const Vector3d& v) { return std::sqrt(dot(v, v)); }
  static double own_turning(const MovingCore& core, const Vector3d& n) {
    return length(cross(n, core.rotation)) * core.reach;
  }

  // The points of the body that carries the direction do not move along it.
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
  Vector3d n_;  // in the frame that it is fixed to
  double most_closing_ = 0, most_curved_ = 0;
};

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
  placed.middle = core_vector(moved(eigen_vector(moving.core->middle)));
}

// The cores of one pair; the memory serves the next pair too.
struct CoreScratch {
  Core a, b, placed_a, placed_b;
};

inline CoreScratch& core_scratch_of_thread() {
  thread_local CoreScratch scratch;
  return scratch;
}

// Advances from t along the direction. With `spinning` it also tries directions that rotate with
// either body, and takes the one that leads furthest.
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

inline constexpr int kMostRounds = 256;  // grazing pairs halve the gap per round; most need 1 to 5
inline constexpr int kEasyRounds = 6;  // most pairs have met by then; spinning directions cost more

// The unit vector between the nearest points. If it ends inside an edge, its part along that edge
// is rounding and is removed. For cores that nearly touch it is most of the error, and the gap at
// the ends of the edge would vanish.
inline Vector3d direction_of(const NearestWay& nearest) {
  Vector3d way = eigen_vector(nearest.way);
  if (nearest.corners.size() == 2) {
    const Vector3d edge = eigen_vector(nearest.corners[1] - nearest.corners[0]);
    way -= edge * (dot(way, edge) / dot(edge, edge));
  }
  return way / std::sqrt(dot(way, way));
}

// The time at which the balls around the rotating cores meet; the cores cannot meet earlier. This
// saves a third of all rounds.
inline double time_of_balls(const MovingPair& pair, double tolerance) {
  const double reach = (pair.a.extent + pair.b.extent) + (pair.radii + tolerance);
  return meets_ball(MovingPoint(pair.from, pair.way), reach);
}

// `tolerance`: cores that are this close count as touching.
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
