// How far two cores certainly get that rotate: GJK at a time that goes on. Along the direction of
// the nearest points the gap stays open for a while, which two support points and a bound of the
// motion prove; the search goes on at that time, with the corners that it has. Near contact the
// direction follows the corners: it stays perpendicular to the face, or to the two edges, that is
// nearest, so that few steps are left.
//
// Sources: G. van den Bergen, "Ray Casting against General Convex Objects with Application to
// Continuous Collision Detection", 2004, for the search; B. Mirtich, "Timewarp Rigid Body
// Simulation", SIGGRAPH 2000, for steps by a bound of the motion.
#pragma once

#include <array>
#include <cmath>

#include "impacts/direction_gap.h"
#include "impacts/linear/crossing_scalar.h"
#include "narrowphase/doubles/make_core.h"
#include "narrowphase/doubles/plain_simplex.h"

namespace carom::scalar {

inline constexpr int kMostTurningRounds = 48;  // ten are usual for pairs that meet

class TurningApproach {
 public:
  // Starts at time t. Cores that are `tolerance` apart count as touching.
  TurningApproach(const MovingPair& pair, double t, double tolerance)
      : pair_(pair),
        tolerance_(tolerance),
        fastest_(((std::sqrt(dot(pair.way, pair.way)) + pair.a.speed * pair.a.reach) +
                  pair.b.speed * pair.b.reach) *
                 kSpeedUpwards),
        curved_(pair.a.speed * pair.a.speed * pair.a.reach +
                pair.b.speed * pair.b.speed * pair.b.reach),
        t_(t) {
    run();
  }

  // Until this time the cores are apart; kNever if they are until pair.latest.
  double time() const { return t_; }
  // Whether they touch then, or never. If not, a more careful search has to go on.
  bool is_over() const { return is_over_; }

 private:
  // The rotations at a time, and the vector between the pivots.
  struct Moment {
    Rotation<double> turn_a, turn_b;
    Vector3d arm_a, arm_b, between;
  };

  // A point of each core at the start.
  struct Ends {
    Vector3d on_a, on_b;
  };
  // A corner of B - A at a time, and its velocity.
  struct Corner {
    Vector3d point, rate;
  };

  Moment moment(double t) const {
    const Rotation<double> turn_a = pair_.a.turn(t), turn_b = pair_.b.turn(t);
    return {turn_a, turn_b, rotate(turn_a, pair_.a.arm), rotate(turn_b, pair_.b.arm),
            pair_.from + pair_.way * t};
  }

  static Vector3d turned(const MovingCore& core, const Rotation<double>& turn,
                         const Vector3d& point) {
    return core.turns ? eigen_vector(rotated_core_vector(turn, point)) : point;
  }
  static Vector3d velocity(const MovingCore& core, const Vector3d& turned_point,
                           const Vector3d& arm) {
    return cross(core.rotation, core.turns ? Vector3d(turned_point + arm) : arm);
  }

  Corner place(const Ends& ends, const Moment& now) const {
    const Vector3d a = turned(pair_.a, now.turn_a, ends.on_a);
    const Vector3d b = turned(pair_.b, now.turn_b, ends.on_b);
    return {((b + now.arm_b) + now.between) - (a + now.arm_a),
            (pair_.way + velocity(pair_.b, b, now.arm_b)) - velocity(pair_.a, a, now.arm_a)};
  }

  // The points of the two that are nearest to each other along n.
  Ends lowest(const Vector3d& n, const Moment& now) const {
    return {furthest(pair_.a, now.turn_a, n), furthest(pair_.b, now.turn_b, -n)};
  }
  Vector3d furthest(const MovingCore& core, const Rotation<double>& turn, const Vector3d& n) const {
    const Vector3d own = core.turns ? Vector3d(rotate_back(turn, n)) : n;
    return eigen_vector(support_point(*core.core, core_vector(own), pair_.furthest));
  }

  Vector3d between_middles(const Moment& now) const {
    const Vector3d a = turned(pair_.a, now.turn_a, eigen_vector(pair_.a.core->middle));
    const Vector3d b = turned(pair_.b, now.turn_b, eigen_vector(pair_.b.core->middle));
    return ((b + now.arm_b) + now.between) - (a + now.arm_a);
  }

  void run() {
    Moment now = moment(t_);
    ends_[0] = lowest(between_middles(now), now);
    corner_[0] = place(ends_[0], now);
    used_ = 0b001;
    PlainNearest nearest({}, core_vector(corner_[0].point));
    for (int round = 0; round < kMostTurningRounds; ++round) {
      const double distance = std::sqrt(nearest.squared);
      is_over_ = nearest.is_around ||
                 (!nearest.is_unclear && distance - pair_.radii <= tolerance_);  // see Approach
      if (is_over_ || nearest.is_unclear) return;
      const Vector3d n = eigen_vector(nearest.point) * (1 / distance);
      Ends next = lowest(n, now);
      const Corner low = place(next, now);
      const double gap = dot(n, low.point) - pair_.radii;
      double step = 0;
      if (gap > tolerance_) {
        step = go(n, gap, low, next);
        if (is_over_ || !(step > 0)) return;
        now = moment(t_);
      }
      PlainSimplex simplex;
      simplex.used = used_;
      for (size_t i = 0; i < 3; ++i) {
        if (!(used_ >> i & 1)) continue;
        corner_[i] = place(ends_[i], now);
        simplex.corner[i] = core_vector(corner_[i].point);
      }
      const Corner last = place(next, now);
      const PlainNearest nearer(simplex, core_vector(last.point));
      if (!(step > 0) && !(nearer.squared < nearest.squared)) return;
      replace(nearer.kept, next, last);
      nearest = nearer;
    }
  }

  void replace(unsigned kept, const Ends& ends, const Corner& corner) {
    const unsigned taken = (kept + 1) & ~kept;
    for (size_t i = 0; i < 3; ++i) {
      if (!(taken >> i & 1)) continue;
      ends_[i] = ends;
      corner_[i] = corner;
    }
    used_ = kept | taken;
  }

  // How fast the direction changes that stays perpendicular to the sides of the simplex.
  Vector3d tilt(const Vector3d& n) const {
    const Vector3d none = Vector3d::Zero();
    const auto side = [&](size_t i) -> Corner {
      if (!(used_ >> i & 1)) return {none, none};
      return {corner_[i].point - corner_[0].point, corner_[i].rate - corner_[0].rate};
    };
    const Corner u = side(1), v = side(2);
    const double rise_u = dot(n, u.rate), rise_v = dot(n, v.rate);
    if (used_ == 0b111) {
      const double area = dot(n, cross(u.point, v.point));
      return (cross(v.point, n) * rise_u + cross(n, u.point) * rise_v) * (-1 / area);
    }
    if (used_ == 0b001) return none;
    const Vector3d edge = u.point + v.point;
    return edge * (-(rise_u + rise_v) / dot(edge, edge));
  }

  static double length(const Vector3d& v) { return std::sqrt(dot(v, v)); }

  // Goes to a time until which the gap along n, or along a direction that tilts, is open. Returns
  // by how much; `next` becomes the points that are nearest then. Sets is_over_ and t_ if the gap
  // stays open.
  double go(const Vector3d& n, double gap, const Corner& low, Ends& next) {
    const double aim = tolerance_ / 2, least = tolerance_ / 4, left = 1 - t_;
    const double closing = (length(cross(n, pair_.a.rotation)) * pair_.a.reach +
                            length(cross(n, pair_.b.rotation)) * pair_.b.reach) -
                           dot(n, pair_.way);
    const double sure = closing > 0 ? (gap - aim) / closing : kNever;
    if (sure >= pair_.latest - t_) return never();
    // The time at which the gap closes at its present rate.
    const auto time_to_close = [&](double rate) {
      return rate < 0 ? min((gap - aim) / -rate, left) : left;
    };
    const double rate = dot(n, low.rate);
    Vector3d way = tilt(n);
    const double speed = length(way);
    double curved =
        ((2 * speed) * fastest_ + (1 + speed * left) * curved_) + pair_.radii * (speed * speed);
    double s = time_to_close(rate + dot(way, low.point));
    const bool tilts = curved * (s * s) <= gap;  // from far, a fixed direction leads further
    if (!tilts) {
      way = Vector3d::Zero();
      curved = curved_;
      s = time_to_close(rate);
    }
    if (curved > 0) s = min(s, std::sqrt(8 * gap / curved));
    s = max(s, sure);

    const Vector3d then_n = n + way * s;
    const Moment then = moment(t_ + s);
    const Ends ends = lowest(then_n, then);
    const double then_gap = dot(then_n, place(ends, then).point) - pair_.radii * length(then_n);
    // The gap lies no more than a parabola below its chord.
    const double sag = (curved * (s * s)) / 2, room = gap - least;
    const double falls = (gap - then_gap) + sag, root = falls * falls - (4 * sag) * room;
    double share = 1;
    if (falls > 0 && root >= 0) share = min(2 * room / (falls + std::sqrt(root)), 1.0);
    const double step = max(s * share, sure);
    if (step >= left || t_ + step > pair_.latest) return never();
    if (share > 0.5) next = ends;
    if (!(t_ + step > t_)) return 0;
    t_ += step;
    return step;
  }

  double never() {
    t_ = kNever;
    is_over_ = true;
    return 0;
  }

  const MovingPair& pair_;
  const double tolerance_;
  const double fastest_;  // a bound of the velocity of all corners
  const double curved_;   // and of their acceleration
  double t_;
  bool is_over_ = false;

  // The simplex.
  std::array<Ends, 3> ends_;
  std::array<Corner, 3> corner_;
  unsigned used_ = 0;
};

}  // namespace carom::scalar
