#include "oracle/moving_pair.h"

namespace carom::oracle {

template <class R>
MovingPair<R>::MovingPair(const carom::Shape& shape_a, const Pose& pose_a, const Sweep& sweep_a,
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

template <class R>
void MovingPair<R>::measure() {
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

template <class R>
MotionMoment<R>::MotionMoment(const MovingPair<R>& pair, const R& t, const R& floor, const R& share)
    : pair_(pair), time_(t), a_(pair.a(), t), b_(pair.b(), t), between_(pair.between(t)) {
  if (pair.is_halfspace()) {
    look_along(-b_.normal());
    upper_ = lower_;
    return;
  }
  search(share);
  if (!is_above(floor) && !is_below(floor)) try_everything();
}

template <class R>
R MotionMoment<R>::free_span(const R& delta, const R& floor) const {
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

template <class R>
Vec3<R> MotionMoment<R>::edge(const TurnedShape<R>& shape, const R& side) const {
  return across(shape.ridge(normal_ * side), normal_);
}

template <class R>
Vec3<R> MotionMoment<R>::spin_with(const Vec& edge_a, const Vec& edge_b) const {
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

template <class R>
R MotionMoment<R>::lower_after(const R& delta, const View& view) const {
  const Vec tilt = cross(view.spin, normal_);
  const R speed = dot(normal_, pair_.velocity()) + dot(tilt, between_);
  R gap = dot(normal_, between_) + speed * delta - pair_.bend(view.angle) * delta * delta / 2;
  gap = gap - pair_.radii() - reach_after(delta, view, pair_.a(), a_, R(1));
  if (pair_.is_halfspace()) return gap - pair_.b().offset();
  return gap - reach_after(delta, view, pair_.b(), b_, R(-1));
}

template <class R>
R MotionMoment<R>::reach_after(const R& delta, const View& view, const MovingShape<R>& shape,
                               const TurnedShape<R>& turned, const R& side) const {
  const Vec apart = shape.spin() - view.spin;
  const Vec way = (normal_ - cross(apart, normal_) * delta) * side;
  const bool is_bent = dot(apart, apart) > 0;
  const R turn = is_bent ? (shape.angle() + view.angle) * delta : R(0);
  return turned.reach(way, turn * turn / 2, view.angle == 0);
}

template <class R>
R MotionMoment<R>::longer_span(R inner, const R& delta, const R& floor, const View& view) const {
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

template <class R>
void MotionMoment<R>::look_along(const Vec& normal) {
  normal_ = normal;
  lower_ = lower_after(R(0), View(Vec{}));
}

template <class R>
void MotionMoment<R>::search(const R& share) {
  const R radii = pair_.radii(), exact = pair_.rounding() / 1024;
  const auto support = [&](const Vec& way) { return between_ + b_.corner(way) - a_.corner(-way); };
  const auto enough = [&](const R& lower) { return std::max<R>(exact, (lower - radii) * share); };
  const DistanceProof<R> proof = distance_from_origin<R>(support, enough);
  normal_ = proof.normal;
  lower_ = proof.lower - radii;
  upper_ = proof.upper - radii;
}

template <class R>
void MotionMoment<R>::try_everything() {
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

// The real types that are used.
template class MovingPair<double>;
template class MotionMoment<double>;
template class MovingPair<long double>;
template class MotionMoment<long double>;
}  // namespace carom::oracle
