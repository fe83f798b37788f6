// A convex shape in motion, for the oracle: where its points are at a time in [0, 1].
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "carom/results/sweep.h"
#include "oracle/convex_shape.h"

namespace carom::oracle {

// In coordinates relative to the body's position, which moves: what is left is the rotation. Not
// for several threads at once.
template <class R>
class MovingShape {
 public:
  using Vec = Vec3<R>;

  MovingShape(const carom::Shape& shape, const Pose& pose, const Sweep& sweep)
      : shape_(shape), pose_{Eigen::Vector3d::Zero(), pose.orientation} {
    if (const auto* hull = std::get_if<Hull>(&shape)) {
      place_points(hull->geometry->points());
    } else {
      place(all());
    }
    if (!std::holds_alternative<Sphere>(shape) && !std::holds_alternative<Aabb>(shape)) {
      spin_ = vec3_as<R>(sweep.rotation);
    }
    axis_ = normalized(spin_);
    angle_ = length(spin_);
    measure();
  }

  // At the start: the core's points, and what is around them.
  const std::vector<Vec>& points() const { return points_; }
  const R& radius() const { return radius_; }
  bool is_halfspace() const { return is_halfspace_; }
  const Vec& normal() const { return normal_; }  // of a half-space, as its offset
  const R& offset() const { return offset_; }
  // Of the farthest point from the body's position, and of the core's; of a half-space the first is
  // the distance to its plane.
  const R& bounding_radius() const { return bounding_radius_; }
  const R& core_reach() const { return core_reach_; }

  // Of its segment, box or corners.
  Vec middle() const {
    const size_t count = std::holds_alternative<Triangle>(shape_) ? 3 : points_.size();
    Vec sum;
    for (size_t i = 0; i < count; ++i) sum = sum + points_[i];
    return sum * (1 / R(count));
  }

  // The rotation vector over the interval; zero for what does not turn.
  const Vec& spin() const { return spin_; }
  const R& angle() const { return angle_; }
  // Of the points, from the position and from the axis (zero for what does not turn).
  const std::vector<R>& arms() const { return arms_; }
  const std::vector<R>& axis_arms() const { return axis_arms_; }
  Rotation<R> turn(const R& t) const { return {axis_, angle_ * t}; }

  // With all its features, at a time.
  ConvexShape<R> at(const R& t) const {
    ConvexShape<R> shape = all();
    if (angle_ > 0) shape.rotate(turn(t));
    return shape;
  }

 private:
  // Finding the faces of a hull takes a hundred times as long as judging a motion mostly does.
  const ConvexShape<R>& all() const {
    if (!all_) all_.emplace(shape_, pose_);
    return *all_;
  }

  void place(const ConvexShape<R>& shape) {
    points_ = shape.points;
    radius_ = shape.radius;
    is_halfspace_ = shape.is_halfspace;
    normal_ = shape.normal;
    offset_ = shape.offset;
    bounding_radius_ = shape.bounding_radius;
  }

  void place_points(std::span<const Eigen::Vector3f> points) {
    const Rotation<R> turn(pose_.orientation);
    for (const Eigen::Vector3f& p : points) points_.push_back(turn(vec3_as<R>(p)));
  }

  void measure() {
    for (const Vec& p : points_) {
      arms_.push_back(length(p));
      axis_arms_.push_back(length(cross(axis_, p)));
      core_reach_ = std::max<R>(core_reach_, arms_.back());
    }
    if (!is_halfspace_) bounding_radius_ = core_reach_ + radius_;
  }

  carom::Shape shape_;
  Pose pose_;
  std::vector<Vec> points_;
  R radius_{0}, offset_{0}, bounding_radius_{0}, core_reach_{0}, angle_{0};
  bool is_halfspace_ = false;
  Vec normal_, spin_, axis_;
  std::vector<R> arms_, axis_arms_;
  mutable std::optional<ConvexShape<R>> all_;
};

// The same at one time: support points without a copy of the shape.
template <class R>
class TurnedShape {
 public:
  using Vec = Vec3<R>;

  TurnedShape(const MovingShape<R>& shape, const R& t)
      : shape_(shape), is_turned_(shape.angle() > 0), turn_(shape.turn(is_turned_ ? t : R(0))) {}

  // The core's point that is furthest along a direction.
  Vec corner(const Vec& way) const { return is_turned_ ? turn_(best(way)) : best(way); }
  // How far any point is along a direction, times the length of that, and `bend` times its arm
  // (from the axis, or from the position if the direction turns as well).
  R reach(const Vec& way, const R& bend, bool is_from_axis) const {
    const auto& arms = is_from_axis ? shape_.axis_arms() : shape_.arms();
    const Vec local = is_turned_ ? turn_.back(way) : way;
    R most = -std::numeric_limits<R>::infinity();
    for (size_t i = 0; i < shape_.points().size(); ++i) {
      const R x = dot(shape_.points()[i], local) + (bend > 0 ? bend * arms[i] : R(0));
      if (x > most) most = x;
    }
    return most;
  }
  // From the point that is furthest along a direction to the next one; zero if there is none.
  Vec ridge(const Vec& way) const {
    const Vec local = is_turned_ ? turn_.back(way) : way;
    const Vec& top = best(way);
    const Vec* next = &top;
    R most = -std::numeric_limits<R>::infinity();
    for (const Vec& p : shape_.points()) {
      const R x = dot(p, local);
      if (&p == &top || !(x > most)) continue;
      most = x;
      next = &p;
    }
    return turn_(*next - top);
  }
  // Of a half-space.
  Vec normal() const { return turn_(shape_.normal()); }

 private:
  const Vec& best(const Vec& way) const {
    const Vec local = is_turned_ ? turn_.back(way) : way;
    const auto& points = shape_.points();
    size_t best = 0;
    R most = dot(points[0], local);
    for (size_t i = 1; i < points.size(); ++i) {
      const R x = dot(points[i], local);
      if (x > most) {
        most = x;
        best = i;
      }
    }
    return points[best];
  }

  const MovingShape<R>& shape_;
  bool is_turned_;
  Rotation<R> turn_;
};

}  // namespace carom::oracle
