#include "oracle/moving_shape.h"

namespace carom::oracle {

template <class R>
MovingShape<R>::MovingShape(const carom::Shape& shape, const Pose& pose, const Sweep& sweep)
    : shape_(shape), pose_{Eigen::Vector3d::Zero(), pose.orientation} {
  if (const auto* hull = std::get_if<Hull>(&shape)) {
    place_points(hull->geometry->points());
    radius_ = R(hull->rounding);
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

template <class R>
Vec3<R> MovingShape<R>::middle() const {
  const size_t count = std::holds_alternative<Triangle>(shape_) ? 3 : points_.size();
  Vec sum;
  for (size_t i = 0; i < count; ++i) sum = sum + points_[i];
  return sum * (1 / R(count));
}

template <class R>
ConvexShape<R> MovingShape<R>::at(const R& t) const {
  ConvexShape<R> shape = all();
  if (angle_ > 0) shape.rotate(turn(t));
  return shape;
}

template <class R>
const ConvexShape<R>& MovingShape<R>::all() const {
  if (!all_) all_.emplace(shape_, pose_);
  return *all_;
}

template <class R>
void MovingShape<R>::place(const ConvexShape<R>& shape) {
  points_ = shape.points;
  radius_ = shape.radius;
  is_halfspace_ = shape.is_halfspace;
  normal_ = shape.normal;
  offset_ = shape.offset;
  bounding_radius_ = shape.bounding_radius;
}

template <class R>
void MovingShape<R>::place_points(std::span<const Eigen::Vector3f> points) {
  const Rotation<R> turn(pose_.orientation);
  for (const Eigen::Vector3f& p : points) points_.push_back(turn(vec3_as<R>(p)));
}

template <class R>
void MovingShape<R>::measure() {
  for (const Vec& p : points_) {
    arms_.push_back(length(p));
    axis_arms_.push_back(length(cross(axis_, p)));
    core_reach_ = std::max<R>(core_reach_, arms_.back());
  }
  if (!is_halfspace_) bounding_radius_ = core_reach_ + radius_;
}

template <class R>
R TurnedShape<R>::reach(const Vec& way, const R& bend, bool is_from_axis) const {
  const auto& arms = is_from_axis ? shape_.axis_arms() : shape_.arms();
  const Vec local = is_turned_ ? turn_.back(way) : way;
  R most = -std::numeric_limits<R>::infinity();
  for (size_t i = 0; i < shape_.points().size(); ++i) {
    const R x = dot(shape_.points()[i], local) + (bend > 0 ? bend * arms[i] : R(0));
    if (x > most) most = x;
  }
  return most;
}

template <class R>
Vec3<R> TurnedShape<R>::ridge(const Vec& way) const {
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

template <class R>
const Vec3<R>& TurnedShape<R>::best(const Vec& way) const {
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

// The real types that are used.
template class MovingShape<double>;
template class TurnedShape<double>;
template class MovingShape<long double>;
template class TurnedShape<long double>;
}  // namespace carom::oracle
