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
             const carom::Shape& shape_b, const Pose& pose_b, const Sweep& sweep_b);

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
  void measure();

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
  MotionMoment(const MovingPair<R>& pair, const R& t, const R& floor, const R& share = R(1) / 1024);

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
  R free_span(const R& delta, const R& floor) const;

 private:
  // The edge of a shape at its furthest point along the normal, projected across the normal.
  Vec edge(const TurnedShape<R>& shape, const R& side) const;

  // The angular velocity that keeps the normal perpendicular to an edge of each shape. A zero edge
  // imposes nothing.
  Vec spin_with(const Vec& edge_a, const Vec& edge_b) const;

  // A direction that starts as the normal and turns with constant velocity.
  struct View {
    Vec spin;
    R angle;

    explicit View(const Vec& turn) : spin(turn), angle(length(turn)) {}
  };

  // A lower bound of the separation `delta` later, along the turning direction. It moves all points
  // on straight lines and subtracts a bound of how far their true paths bend. Concave in `delta`.
  R lower_after(const R& delta, const View& view) const;

  // Points of a shape that turns with the direction do not bend.
  R reach_after(const R& delta, const View& view, const MovingShape<R>& shape,
                const TurnedShape<R>& turned, const R& side) const;

  // A free span of at least `inner`, longer if this turning normal proves it. It uses false
  // position (Illinois) on a concave function. It aims a little above the floor, because rounding
  // could reject a span that ends exactly there.
  R longer_span(R inner, const R& delta, const R& floor, const View& view) const;

  void look_along(const Vec& normal);

  void search(const R& share);

  void try_everything();

  const MovingPair<R>& pair_;
  R time_;
  TurnedShape<R> a_, b_;
  Vec between_;
  Vec normal_;
  R lower_{0}, upper_{0};
};

}  // namespace carom::oracle
