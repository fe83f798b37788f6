// A moving convex shape for the oracle: its points at a time in [0, 1].
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "carom/results/sweep.h"
#include "oracle/convex_shape.h"

namespace carom::oracle {

// Coordinates are relative to the body's moving position, so only the rotation remains. Not for
// concurrent use, because at() caches.
template <class R>
class MovingShape {
 public:
  using Vec = Vec3<R>;

  MovingShape(const carom::Shape& shape, const Pose& pose, const Sweep& sweep);

  // At time 0: the core's points and the radius around them.
  const std::vector<Vec>& points() const { return points_; }
  const R& radius() const { return radius_; }
  bool is_halfspace() const { return is_halfspace_; }
  const Vec& normal() const { return normal_; }  // of a half-space, as is offset()
  const R& offset() const { return offset_; }
  // The greatest distance from the body's position of any point, and of a core point. For a
  // half-space bounding_radius() is the distance to its plane.
  const R& bounding_radius() const { return bounding_radius_; }
  const R& core_reach() const { return core_reach_; }

  // The centroid of its segment, box or corners.
  Vec middle() const;

  // The rotation vector over the interval; zero for shapes that do not turn.
  const Vec& spin() const { return spin_; }
  const R& angle() const { return angle_; }
  // Distances of the points from the position and from the axis of rotation (zero if it does not
  // turn).
  const std::vector<R>& arms() const { return arms_; }
  const std::vector<R>& axis_arms() const { return axis_arms_; }
  Rotation<R> turn(const R& t) const { return {axis_, angle_ * t}; }

  // The shape at a time with all its features.
  ConvexShape<R> at(const R& t) const;

 private:
  // Built only when needed: finding a hull's faces takes a hundred times as long as most judgements
  // of a motion.
  const ConvexShape<R>& all() const;

  void place(const ConvexShape<R>& shape);

  void place_points(std::span<const Eigen::Vector3f> points);

  void measure();

  carom::Shape shape_;
  Pose pose_;
  std::vector<Vec> points_;
  R radius_{0}, offset_{0}, bounding_radius_{0}, core_reach_{0}, angle_{0};
  bool is_halfspace_ = false;
  Vec normal_, spin_, axis_;
  std::vector<R> arms_, axis_arms_;
  mutable std::optional<ConvexShape<R>> all_;
};

// The shape at one time: support points without a copy of the shape.
template <class R>
class TurnedShape {
 public:
  using Vec = Vec3<R>;

  TurnedShape(const MovingShape<R>& shape, const R& t)
      : shape_(shape), is_turned_(shape.angle() > 0), turn_(shape.turn(is_turned_ ? t : R(0))) {}

  // The core's point that is furthest along a direction.
  Vec corner(const Vec& way) const { return is_turned_ ? turn_(best(way)) : best(way); }
  // The largest over all points of point . way + `bend` * arm. The arm is the distance from the
  // axis, or from the position if the direction turns as well.
  R reach(const Vec& way, const R& bend, bool is_from_axis) const;
  // The edge from the furthest point along a direction to the second furthest; zero if there is
  // none.
  Vec ridge(const Vec& way) const;
  // The normal of a half-space.
  Vec normal() const { return turn_(shape_.normal()); }

 private:
  const Vec& best(const Vec& way) const;

  const MovingShape<R>& shape_;
  bool is_turned_;
  Rotation<R> turn_;
};

}  // namespace carom::oracle
