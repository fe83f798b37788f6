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

#include "carom/kernel/contact.h"
#include "narrowphase/core_ref.h"
#include "narrowphase/nearest_way.h"
#include "sweep/crossing_ref.h"
#include "sweep/turning_ref.h"

namespace carom::reference {

// A core that moves: its points at time t are turned by t * rotation, then moved. `arm`, too, is
// turned, from where the body turns to where the core is; the core itself only if `turns`.
struct MovingCore {
  const Core* core = nullptr;
  Vector3d arm = Vector3d::Zero();
  Vector3d rotation = Vector3d::Zero();
  bool turns = true;
  double speed = 0;  // of turning, radians
  double reach = 0;  // the furthest point from where the body turns

  // World axes at time t.
  Rotation<double> turn(double t) const {
    if (!(speed > 0)) return {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
    return rotation_of(turn_by(rotation, t));
  }
};

inline MovingCore moving_core(const Core& core, const Vector3d& arm, const Vector3d& rotation,
                              bool turns) {
  constexpr double kUpwards = 1 + 0x1p-40;
  double greatest = 0;
  for (size_t i = 0; i < core.size(); ++i) {
    const CoreVector p = core.point(i);
    greatest = max(greatest, dot(p, p));
  }
  const double reach = (turns ? std::sqrt(greatest) : 0.0) + std::sqrt(dot(arm, arm));
  const bool is_round_about_pivot = !(reach > 0);
  const Vector3d turning = is_round_about_pivot ? Vector3d(Vector3d::Zero()) : rotation;
  return {&core, arm, turning, turns, angle_of(turning) * kUpwards, reach * kUpwards};
}

// What a moving core reaches along a direction at a time.
struct MovingSupport {
  double height;
  double rate;     // of the furthest point
  Vector3d point;  // it, from where the body turns

  MovingSupport(const MovingCore& moving, const Vector3d& n, double t, FurthestPoint furthest) {
    const Rotation<double> turn = moving.turn(t);
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

// Two moving cores, B at `from` + t * `way`.
struct MovingPair {
  MovingCore a, b;
  Vector3d from, way;
  double radii = 0;
  FurthestPoint furthest = nullptr;
};

// The gap along a fixed direction from A to B, radii included, as a function of time.
class FixedDirectionGap {
 public:
  FixedDirectionGap(const MovingPair& pair, const Vector3d& n) : pair_(pair), n_(n) {
    const auto turning = [&](const MovingCore& core) {
      const Vector3d across = cross(n, core.rotation);
      return std::sqrt(dot(across, across)) * core.reach;
    };
    most_closing_ = (turning(pair.a) + turning(pair.b)) - dot(n, pair.way);
  }

  struct Value {
    double gap, rate;
  };
  Value at(double t) const {
    const MovingSupport a(pair_.a, n_, t, pair_.furthest), b(pair_.b, -n_, t, pair_.furthest);
    const Vector3d place = pair_.from + pair_.way * t;
    return {(dot(n_, place) - (a.height + b.height)) - pair_.radii,
            dot(n_, pair_.way) - (a.rate + b.rate)};
  }

  // Bounds for all times.
  double most_closing() const { return most_closing_; }
  double most_curved() const {
    const MovingCore &a = pair_.a, &b = pair_.b;
    return a.speed * a.speed * a.reach + b.speed * b.speed * b.reach;
  }

 private:
  const MovingPair& pair_;
  const Vector3d n_;
  double most_closing_;
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
inline constexpr int kMostSteps = 16;    // along one direction
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
    auto then = now;
    for (int halving = 0;; ++halving) {
      if (s <= sure || halving == kMostHalvings) s = sure;
      then = gap.at(t + s);
      if (s <= sure || stays_above(now.gap, then.gap, gap.most_curved(), s, least)) break;
      s = max(s / 2, sure);
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

// `tolerance`: the distance at which they have met.
inline AdvancementResult time_of_cores(const MovingPair& pair, double tolerance,
                                       CoreScratch& scratch) {
  constexpr int kMostRounds = 256;  // grazing halves the gap at each; most pairs need five
  double t = 0;
  for (int round = 0; round < kMostRounds; ++round) {
    place(pair.a, Vector3d::Zero(), t, scratch.placed_a);
    place(pair.b, pair.from + pair.way * t, t, scratch.placed_b);
    const NearestWay nearest = nearest_way(scratch.placed_a, scratch.placed_b, pair.furthest);
    const double distance = std::sqrt(dot(nearest.way, nearest.way));
    const bool is_touching = nearest.corners.size() == 4 || distance <= kTouchingCores;
    if (is_touching || distance - pair.radii <= tolerance) return {t};
    const FixedDirectionGap gap(pair, eigen_vector(nearest.way * (1 / distance)));
    const double next = advance(gap, t, tolerance);
    if (next > 1) return {kNever};
    if (next == t) return {t, distance - pair.radii <= 2 * tolerance ? Status::ok : Status::budget};
    t = next;
  }
  return {t, Status::budget};
}

// The height of a moving core over a plane that may turn, as a function of time.
class PlaneGap {
 public:
  // n . x <= offset is the half-space at the start; the core is seen from where it turns.
  PlaneGap(const MovingPair& pair, const Vector3d& n, double offset, const Vector3d& rotation)
      : pair_(pair), n_(n), offset_(offset), rotation_(rotation), speed_(angle_of(rotation)) {}

  struct Value {
    double gap, rate;
  };
  Value at(double t) const {
    const Vector3d n = speed_ > 0 ? rotate(rotation_of(turn_by(rotation_, t)), n_) : n_;
    const MovingSupport lowest(pair_.b, -n, t, pair_.furthest);
    const Vector3d place = pair_.from + pair_.way * t;
    const double height = dot(n, place) - lowest.height;
    const double tilting = dot(cross(rotation_, n), Vector3d(place + lowest.point));
    return {(height - offset_) - pair_.radii, (dot(n, pair_.way) - lowest.rate) + tilting};
  }

  double most_closing() const {
    const double turning = speed_ * furthest() + pair_.b.speed * pair_.b.reach;
    return turning + (speed_ > 0 ? length(pair_.way) : -dot(n_, pair_.way));
  }
  double most_curved() const {
    const double own = pair_.b.speed * pair_.b.speed * pair_.b.reach;
    const double fastest = length(pair_.way) + pair_.b.speed * pair_.b.reach;
    return own + speed_ * (speed_ * furthest() + 2 * fastest);
  }

 private:
  static double length(const Vector3d& v) { return std::sqrt(dot(v, v)); }
  // From where the half-space turns.
  double furthest() const { return length(pair_.from) + length(pair_.way) + pair_.b.reach; }

  const MovingPair& pair_;
  const Vector3d n_;
  const double offset_;
  const Vector3d rotation_;
  const double speed_;
};

// The core B of the pair against a half-space at the place of A.
inline AdvancementResult time_over_plane(const MovingPair& pair, const Vector3d& n, double offset,
                                         const Vector3d& rotation, double tolerance) {
  constexpr int kMostRounds = 256;
  const PlaneGap gap(pair, n, offset, rotation);
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

}  // namespace carom::reference
