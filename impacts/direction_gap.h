// The gap between two moving cores along a direction, as a function of time. The direction is fixed
// in the world or rotates: with a body, or with an edge of each.
#pragma once

#include <cmath>

#include "impacts/turning.h"
#include "narrowphase/doubles/core.h"
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
    greatest = max(greatest, std::sqrt(dot(p, p)) + core.roundness_of(i));
  }
  const double size = greatest, arm_length = std::sqrt(dot(arm, arm));
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
  double latest = 1;  // later times are of no use
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
    const Vector3d corner = eigen_vector(support_point(*moving.core, core_vector(own), furthest));
    const Vector3d arm = rotate(turn, moving.arm);
    const Vector3d turned = moving.turns ? Vector3d(rotate(turn, corner) + arm) : arm;
    point = moving.turns ? turned : Vector3d(corner + arm);
    height = dot(n, point);
    rate = dot(n, cross(moving.rotation, turned));
  }
};

// What a direction is fixed to. A shape that lies flat on a face needs a direction that rotates
// with the face's body. Two edges that cross need one that stays perpendicular to both: along any
// other, an end of an edge that rotates soon closes the gap.
enum class FixedTo { world, a, b, edges };

// The gap along a direction from A to B, minus the radii, as a function of time.
class DirectionGap {
 public:
  // The direction is `n` at time t, in world axes.
  DirectionGap(const MovingPair& pair, const Vector3d& n, double t, FixedTo fixed)
      : pair_(pair), fixed_(fixed), n_(n), spin_(Vector3d::Zero()) {
    if (fixed == FixedTo::world) {
      set_bounds_of_world();
      return;
    }
    const MovingCore& frame = fixed == FixedTo::a ? pair.a : pair.b;
    n_ = rotate_back(frame.turn(t), n);
    spin_ = frame.rotation;
    set_bounds(t);
  }

  // The direction rotates with the velocity `spin`, with the edges of both.
  DirectionGap(const MovingPair& pair, const Vector3d& n, double t, const Vector3d& spin)
      : pair_(pair), fixed_(FixedTo::edges), n_(n), spin_(spin), start_(t) {
    set_bounds(t);
  }

  struct Value {
    double gap, rate;
  };
  Value at(double t) const {
    const Rotation<double> turn_a = pair_.a.turn(t), turn_b = pair_.b.turn(t);
    const Vector3d n = direction(t, turn_a, turn_b);
    const MovingSupport a(pair_.a, turn_a, n, pair_.furthest);
    const MovingSupport b(pair_.b, turn_b, -n, pair_.furthest);
    const Vector3d place = pair_.from + pair_.way * t;
    double rate = dot(n, pair_.way) - (a.rate + b.rate);
    if (fixed_ != FixedTo::world) {
      rate += dot(cross(spin_, n), Vector3d((place + b.point) - a.point));
    }
    return {(dot(n, place) - (a.height + b.height)) - pair_.radii, rate};
  }

  // Bounds from t on: how fast the gap closes, and its second derivatives.
  double most_closing() const { return most_closing_; }
  double most_curved() const { return most_curved_; }

 private:
  static double length(const Vector3d& v) { return std::sqrt(dot(v, v)); }

  Vector3d direction(double t, const Rotation<double>& turn_a,
                     const Rotation<double>& turn_b) const {
    switch (fixed_) {
      case FixedTo::world:
        return n_;
      case FixedTo::a:
        return rotate(turn_a, n_);
      case FixedTo::b:
        return rotate(turn_b, n_);
      default:
        return rotate(rotation_of(turn_by(spin_, t - start_)), n_);
    }
  }

  static double own_turning(const MovingCore& core, const Vector3d& n) {
    return length(cross(n, core.rotation)) * core.reach;
  }
  void set_bounds_of_world() {
    const MovingCore &a = pair_.a, &b = pair_.b;
    most_closing_ = (own_turning(a, n_) + own_turning(b, n_)) - dot(n_, pair_.way);
    most_curved_ = a.speed * a.speed * a.reach + b.speed * b.speed * b.reach;
  }

  // How fast a point of the core moves as seen from the direction, and its second derivative along
  // it. With s and w the velocities of both, the latter is that of n.p, which is
  // n.[(s - w) x ((s - w) x p) - (s x w) x p]; where the core does not rotate, w is zero.
  double seen_closing(const MovingCore& core, double speed) const {
    const Vector3d apart = spin_ - core.rotation;
    return length(apart) * core.reach + speed * (core.extent - core.reach);
  }
  double seen_curved(const MovingCore& core, double speed) const {
    const Vector3d apart = spin_ - core.rotation;
    const double of_rotating = dot(apart, apart) + length(cross(spin_, core.rotation));
    return of_rotating * core.reach + speed * speed * (core.extent - core.reach);
  }
  void set_bounds(double t) {
    const MovingCore &a = pair_.a, &b = pair_.b;
    const double start = length(pair_.from + pair_.way * t), end = length(pair_.from + pair_.way);
    const double furthest = max(start, end), fastest = length(pair_.way), speed = length(spin_);
    most_closing_ =
        ((speed * furthest + fastest) + (seen_closing(a, speed) + seen_closing(b, speed))) *
        kSpeedUpwards;
    most_curved_ = (speed * (speed * furthest + 2 * fastest) +
                    (seen_curved(a, speed) + seen_curved(b, speed))) *
                   kSpeedUpwards;
  }

  const MovingPair& pair_;
  const FixedTo fixed_;
  Vector3d n_;  // in the frame that it is fixed to
  Vector3d spin_;
  double start_ = 0;  // when the direction is n_, if it rotates with edges
  double most_closing_ = 0, most_curved_ = 0;
};

}  // namespace carom::scalar
