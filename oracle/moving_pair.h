// Two moving convex shapes for the oracle: their separation at a time, and how long they provably
// stay separate.
#pragma once

#include <cmath>
#include <utility>

#include "oracle/convex_oracle.h"
#include "oracle/moving_shape.h"
#include "oracle/simplex_search.h"

namespace carom::oracle {

// Coordinates are relative to the moving position of A. A half-space is always B, so the shapes may
// be swapped.
template <class R>
class MovingPair {
 public:
  using Vec = Vec3<R>;

  MovingPair(const carom::Shape& shape_a, const Pose& pose_a, const Sweep& sweep_a,
             const carom::Shape& shape_b, const Pose& pose_b, const Sweep& sweep_b)
      : is_swapped_(std::holds_alternative<Halfspace>(shape_a)),
        a_(is_swapped_ ? MovingShape<R>(shape_b, pose_b, sweep_b)
                       : MovingShape<R>(shape_a, pose_a, sweep_a)),
        b_(is_swapped_ ? MovingShape<R>(shape_a, pose_a, sweep_a)
                       : MovingShape<R>(shape_b, pose_b, sweep_b)),
        between_(vec3_as<R>(pose_b.position) - vec3_as<R>(pose_a.position)),
        velocity_(vec3_as<R>(sweep_b.displacement) - vec3_as<R>(sweep_a.displacement)) {
    if (is_swapped_) {
      between_ = -between_;
      velocity_ = -velocity_;
    }
    measure();
  }

  bool is_swapped() const { return is_swapped_; }
  bool is_halfspace() const { return b_.is_halfspace(); }
  const MovingShape<R>& a() const { return a_; }
  const MovingShape<R>& b() const { return b_; }
  const Vec& velocity() const { return velocity_; }
  R radii() const { return a_.radius() + b_.radius(); }
  Vec between(const R& t) const { return between_ + velocity_ * t; }

  // Sum of the bounding radii about the positions; a half-space adds nothing.
  const R& size() const { return size_; }
  // A bound of how far a point of one shape moves relative to the other.
  const R& travel() const { return travel_; }
  // A bound of the rounding error of a separation in double precision.
  R rounding() const { return 64 * R(0x1p-52) * (size_ + travel_ + reach_); }
  // The path from one position to the other, projected on a direction that turns by `angle` over
  // the interval, deviates from a straight one by at most half of this times the time squared.
  R bend(const R& angle) const { return angle * (angle * distance_ + 2 * length(velocity_)); }

 private:
  void measure() {
    size_ = a_.bounding_radius();
    distance_ = std::max<R>(length(between(R(0))), length(between(R(1))));
    travel_ = length(velocity_) + a_.angle() * size_;
    reach_ = distance_;
    if (is_halfspace()) {
      travel_ += b_.angle() * (distance_ + size_);
      reach_ += b_.bounding_radius();
    } else {
      size_ += b_.bounding_radius();
      travel_ += b_.angle() * b_.bounding_radius();
    }
  }

  bool is_swapped_;
  MovingShape<R> a_, b_;
  Vec between_, velocity_;
  R size_{0}, travel_{0};
  R distance_{0};  // the greatest distance between the positions
  R reach_{0};     // the largest coordinates
};

// A moving pair at one time.
template <class R>
class MotionMoment {
 public:
  using Vec = Vec3<R>;

  // If the quick search puts the separation above `floor` or not above it, brute force is skipped.
  // The search bounds positive separations only to within `share` of them.
  MotionMoment(const MovingPair<R>& pair, const R& t, const R& floor, const R& share = R(1) / 1024)
      : pair_(pair), time_(t), a_(pair.a(), t), b_(pair.b(), t), between_(pair.between(t)) {
    if (pair.is_halfspace()) {
      look_along(-b_.normal());
      upper_ = lower_;
      return;
    }
    search(share);
    if (!is_above(floor) && !is_below(floor)) try_everything();
  }

  const R& time() const { return time_; }
  // Bounds of the separation. `lower` is the gap along the normal. `upper` need not be the true
  // depth of shapes that overlap.
  const R& lower() const { return lower_; }
  const R& upper() const { return upper_; }
  // Unit, from A to B.
  const Vec& normal() const { return normal_; }

  bool is_above(const R& floor) const { return lower_ > floor; }
  // Also true if only rounding keeps the separation above the floor.
  bool is_below(const R& floor) const { return upper_ <= floor + pair_.rounding() / 16; }

  // A time span, up to `delta` (which may be negative), in which the separation provably stays
  // above `floor`. The proof looks along the normal, fixed or turning with a shape or with the
  // closest features.
  R free_span(const R& delta, const R& floor) const {
    if (!(lower_ > floor)) return R(0);
    const Vec spin_a = pair_.a().spin(), spin_b = pair_.b().spin();
    if (pair_.is_halfspace()) return longer_span(R(0), delta, floor, View(spin_b));
    R span = longer_span(R(0), delta, floor, View(Vec{}));
    if (!(pair_.a().angle() > 0 || pair_.b().angle() > 0)) return span;
    const Vec edge_a = edge(a_, R(1)), edge_b = edge(b_, R(-1));
    for (const Vec& spin : {spin_a, spin_b, spin_with(edge_a, Vec{}), spin_with(Vec{}, edge_b),
                            spin_with(edge_a, edge_b)}) {
      span = longer_span(span, delta, floor, View(spin));
    }
    return span;
  }

 private:
  // The edge of a shape at its furthest point along the normal, projected across the normal.
  Vec edge(const TurnedShape<R>& shape, const R& side) const {
    return across(shape.ridge(normal_ * side), normal_);
  }

  // The angular velocity that keeps the normal perpendicular to an edge of each shape. A zero edge
  // imposes nothing.
  Vec spin_with(const Vec& edge_a, const Vec& edge_b) const {
    const R rise_a = dot(cross(pair_.a().spin(), edge_a), normal_);
    const R rise_b = dot(cross(pair_.b().spin(), edge_b), normal_);
    const R angle = dot(normal_, cross(edge_a, edge_b));
    Vec tilt = cross(normal_, edge_b) * rise_a - cross(normal_, edge_a) * rise_b;
    if (angle != 0) {
      tilt = tilt * (1 / angle);
    } else {
      const Vec both = edge_a * rise_a + edge_b * rise_b;
      const R squared = dot(edge_a, edge_a) + dot(edge_b, edge_b);
      tilt = squared > 0 ? both * (-1 / squared) : Vec{};
    }
    return cross(normal_, tilt);
  }

  // A direction that starts as the normal and turns with constant velocity.
  struct View {
    Vec spin;
    R angle;

    explicit View(const Vec& turn) : spin(turn), angle(length(turn)) {}
  };

  // A lower bound of the separation `delta` later, along the turning direction. It moves all points
  // on straight lines and subtracts a bound of how far their true paths bend. Concave in `delta`.
  R lower_after(const R& delta, const View& view) const {
    const Vec tilt = cross(view.spin, normal_);
    const R speed = dot(normal_, pair_.velocity()) + dot(tilt, between_);
    R gap = dot(normal_, between_) + speed * delta - pair_.bend(view.angle) * delta * delta / 2;
    gap = gap - pair_.radii() - reach_after(delta, view, pair_.a(), a_, R(1));
    if (pair_.is_halfspace()) return gap - pair_.b().offset();
    return gap - reach_after(delta, view, pair_.b(), b_, R(-1));
  }

  // Points of a shape that turns with the direction do not bend.
  R reach_after(const R& delta, const View& view, const MovingShape<R>& shape,
                const TurnedShape<R>& turned, const R& side) const {
    const Vec apart = shape.spin() - view.spin;
    const Vec way = (normal_ - cross(apart, normal_) * delta) * side;
    const bool is_bent = dot(apart, apart) > 0;
    const R turn = is_bent ? (shape.angle() + view.angle) * delta : R(0);
    return turned.reach(way, turn * turn / 2, view.angle == 0);
  }

  // A free span of at least `inner`, longer if this turning normal proves it. It uses false
  // position (Illinois) on a concave function. It aims a little above the floor, because rounding
  // could reject a span that ends exactly there.
  R longer_span(R inner, const R& delta, const R& floor, const View& view) const {
    const auto gap_after = [&](const R& t) { return lower_after(t, view) - floor; };
    R outer = delta, outer_gap = gap_after(delta);
    if (outer_gap > 0) return delta;
    R inner_gap = gap_after(inner);
    const R margin = std::min<R>(pair_.rounding() / 64, inner_gap / 2);
    for (int i = 0; i < 40 && inner_gap > 2 * margin; ++i) {
      const R share = std::max<R>((inner_gap - margin) / (inner_gap - outer_gap), 0);
      const R next = inner + (outer - inner) * share;
      const R gap = gap_after(next);
      if (gap > 0) {
        const bool is_near = std::fabs(next - inner) < std::fabs(next) / 64;
        inner = next;
        inner_gap = gap;
        outer_gap /= 2;
        if (is_near && i > 2) break;
      } else {
        outer = next;
        outer_gap = gap;
      }
    }
    return inner;
  }

  void look_along(const Vec& normal) {
    normal_ = normal;
    lower_ = lower_after(R(0), View(Vec{}));
  }

  void search(const R& share) {
    const R radii = pair_.radii(), exact = pair_.rounding() / 1024;
    const auto support = [&](const Vec& way) {
      return between_ + b_.corner(way) - a_.corner(-way);
    };
    const auto enough = [&](const R& lower) { return std::max<R>(exact, (lower - radii) * share); };
    const DistanceProof<R> proof = distance_from_origin<R>(support, enough);
    normal_ = proof.normal;
    lower_ = proof.lower - radii;
    upper_ = proof.upper - radii;
  }

  void try_everything() {
    ConvexShape<R> b = pair_.b().at(time_);
    b.translate(between_);
    const ConvexSeparation<R> best = separation_with_normal(pair_.a().at(time_), b);
    upper_ = std::min<R>(upper_, best.value);
    const Vec known = normal_;
    const R lower = lower_;
    look_along(best.normal);
    if (lower_ >= lower) return;
    normal_ = known;
    lower_ = lower;
  }

  const MovingPair<R>& pair_;
  R time_;
  TurnedShape<R> a_, b_;
  Vec between_;
  Vec normal_;
  R lower_{0}, upper_{0};
};

}  // namespace carom::oracle
