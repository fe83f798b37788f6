// Capsule (A) against triangle (B): the capsule's segment against the triangle.
//
// The Minkowski difference of a segment and a triangle is a prism. Its surface is made of the
// differences of the segment's ends and the triangle, and of the segment and the edges. The
// distance to the nearest of these is the separation of the cores, negative if the segment passes
// through the triangle (C. Ericson, Real-Time Collision Detection, 2005, sections 5.1.10 and
// 5.3.4).
#pragma once

#include "narrowphase/doubles/special_triangle.h"
#include "narrowphase/features/rounded_scalar.h"
#include "narrowphase/features/triangle_scalar.h"

namespace carom::scalar {

// The segment p + d s, s from 0 to 1, against a triangle; corners relative to the same origin.
template <class Real>
class SegmentTriangle {
 public:
  using Vector = Vector3<Real>;
  using Tolerance = CoreTolerance<Real>;

  SegmentTriangle(const Vector& p, const Vector& d, const TriangleCore<Real>& triangle)
      : p_(p), d_(d), triangle_(triangle) {
    const Real squared = dot(triangle.normal, triangle.normal);
    unit_normal_ = triangle.normal * (triangle.has_face ? 1 / std::sqrt(squared) : 0);
    for (size_t i = 0; i < 3; ++i) r_[i] = triangle.corner[i] - p;
    height_p_ = -dot(r_[0], unit_normal_);
    height_q_ = height_p_ + dot(d, unit_normal_);
    find_nearest_edge();
    passes_through_ = triangle.has_face && passes_through();
    if (is_over_face()) {
      take_face();
    } else {
      take_edge();
    }
  }

  bool is_face() const { return is_face_; }
  bool is_degenerate() const { return is_degenerate_; }
  Real core_separation() const { return passes_through_ ? -distance_ : distance_; }
  const Vector& normal() const { return normal_; }
  Vector point() const { return p_ + d_ * s_; }  // on the segment

  // Whether the gap along the normal is less than the separation.
  bool is_tilted() const {
    const Real zero = 0;
    const Real low = min(min(dot(normal_, r_[0]), dot(normal_, r_[1])), dot(normal_, r_[2]));
    return low - max(dot(normal_, d_), zero) < core_separation() - Tolerance::kTilt;
  }
  bool is_near_edge() const { return !is_face_ && distance_ <= Tolerance::kNearEdges; }

 private:
  void find_nearest_edge() {
    for (size_t i = 0; i < 3; ++i) {
      const auto near = nearest_of_segments(r_[i], d_, triangle_.edge[i]);
      const Real squared = dot(near.delta, near.delta);
      if (i > 0 && !(squared < edge_squared_)) continue;
      edge_ = i;
      nearest_ = near;
      edge_squared_ = squared;
    }
  }

  // Whether the ends are on both sides of the plane, and the line on the same side of all edges. A
  // segment that lies in the plane, up to rounding, does not pass through it.
  bool passes_through() const {
    if (!(std::fabs(height_q_ - height_p_) > Tolerance::kShallow)) return false;
    const Real zero = 0;
    if (min(height_p_, height_q_) > zero || max(height_p_, height_q_) < zero) return false;
    Real side[3];
    for (size_t i = 0; i < 3; ++i) side[i] = dot(r_[i], cross(d_, triangle_.edge[i]));
    return min(min(side[0], side[1]), side[2]) >= zero ||
           max(max(side[0], side[1]), side[2]) <= zero;
  }

  bool starts_nearer() const { return std::fabs(height_p_) <= std::fabs(height_q_); }

  // Whether the end that is nearer to the plane is over the face, and no edge is nearer.
  bool is_over_face() const {
    if (!triangle_.has_face) return false;
    const Vector end = d_ * (starts_nearer() ? Real(0) : Real(1));
    for (size_t i = 0; i < 3; ++i) {
      if (dot(Vector(r_[i] - end), cross(triangle_.normal, triangle_.edge[i])) > 0) return false;
    }
    // An edge below the end is equally near, up to rounding: then it takes the face.
    const Real height = starts_nearer() ? height_p_ : height_q_;
    return height * height <= edge_squared_ * Tolerance::kTie;
  }

  // The other end tells on which side of the face the segment lies.
  void take_face() {
    is_face_ = true;
    s_ = starts_nearer() ? Real(0) : Real(1);
    distance_ = std::fabs(starts_nearer() ? height_p_ : height_q_);
    const Real other = starts_nearer() ? height_q_ : height_p_;
    normal_ = other >= 0 ? Vector(-unit_normal_) : unit_normal_;
  }

  void take_edge() {
    auto [way, is_across] = way_between(nearest_);
    s_ = nearest_.s;
    // If `way` is perpendicular to the edge and the segment, its sign is that for which the third
    // corner of the triangle lies ahead.
    const Vector ahead = passes_through_ ? Vector(-nearest_.delta) : nearest_.delta;
    const Vector far = is_across ? Vector(ahead - triangle_.edge[(edge_ + 2) % 3]) : ahead;
    if (dot(way, far) < 0) way = -way;
    const Real length = std::sqrt(dot(way, way));
    const Real to_unit = 1 / length;
    distance_ = is_across ? std::fabs(dot(nearest_.delta, way)) * to_unit : length;
    normal_ = way * to_unit;
    if constexpr (std::is_same_v<Real, double>) {
      if (distance_ <= Tolerance::kNearEdges) take_normal_of_touching();
    }
  }

  // Between cores that touch there is no good direction: the nearest features give the normal.
  void take_normal_of_touching() {
    const Vector n = cross(d_, nearest_.e);
    const bool is_across = have_common_normal(n, nearest_.dd, nearest_.ee);
    if (is_across && (is_inside(nearest_.s) || !triangle_.has_face)) {
      const Vector inwards = -triangle_.edge[(edge_ + 2) % 3];
      normal_ = n * ((dot(n, inwards) < 0 ? -1 : 1) / std::sqrt(dot(n, n)));
    } else if (triangle_.has_face) {
      normal_ = height_p_ + height_q_ >= 0 ? Vector(-unit_normal_) : unit_normal_;
    } else if (distance_ <= Real(kCoincident)) {
      is_degenerate_ = true;
      normal_ = any_perpendicular(nearest_.dd >= nearest_.ee ? d_ : nearest_.e);
    }
  }

  Vector p_, d_;
  const TriangleCore<Real>& triangle_;
  Vector unit_normal_;
  Vector r_[3];               // from p to the corners
  Real height_p_, height_q_;  // of the ends over the plane of the face
  size_t edge_ = 0;           // the number of the nearest edge
  Real edge_squared_ = 0;     // its squared distance
  NearestOfSegments<Real> nearest_;
  bool passes_through_;
  bool is_face_ = false;
  bool is_degenerate_ = false;
  Real s_;
  Real distance_;
  Vector normal_;
};

template <class Real>
SeparationAs<Real> separation(const CapsuleShape<Real>& capsule,
                              const TriangleShape<Real>& triangle, const PairPose<Real>& pose) {
  if (triangle.is_special()) return special_triangle(capsule, triangle, pose);
  using Vector = Vector3<Real>;
  const Rotation<Real> turn_a = rotation_of(pose.a);
  const Rotation<Real> turn_b = rotation_of(pose.b);
  std::array<Vector, 3> corners;
  for (size_t i = 0; i < 3; ++i) corners[i] = rotate(turn_b, triangle.corners[i]) + pose.d;
  const TriangleCore<Real> core(corners);
  const SegmentTriangle<Real> test(rotate(turn_a, capsule.a),
                                   rotate(turn_a, Vector(capsule.b - capsule.a)), core);
  const Vector point = test.point();
  SeparationAs<Real> result =
      grown<Real>(point, point + test.normal() * test.core_separation(), test.normal(),
                  test.core_separation(), capsule.radius, 0, pose);
  result.is_unsure = result.is_unsure || test.is_near_edge() || test.is_tilted();
  if (test.is_degenerate()) result.status = Status::degenerate;
  return result;
}

}  // namespace carom::scalar
