// Capsule against capsule: the nearest points of their segments.
//
// Source: C. Ericson, Real-Time Collision Detection, 2005, section 5.1.9. The normal is computed
// from the nearest features and then checked: if the gap along it is less than the distance, float
// has lost the normal.
#pragma once

#include "narrowphase/features/rounded_scalar.h"
#include "narrowphase/features/segment_scalar.h"
#include "narrowphase/scalar/shapes.h"

namespace carom::scalar {

// The normal of two segments that touch: perpendicular to both or, if they are parallel, to the
// longer one.
template <class Real>
Vector3<Real> normal_of_touching(const NearestOfSegments<Real>& near) {
  const Vector3<Real> n = cross(near.d, near.e);
  if (!have_common_normal(n, near.dd, near.ee)) {
    return any_perpendicular(near.dd >= near.ee ? near.d : near.e);
  }
  return n * (1 / std::sqrt(dot(n, n)));
}

// The gap between the projections of p + d s and q + e t on the unit vector n (r = q - p).
template <class Real>
Real gap_of_segments(const Vector3<Real>& n, const Vector3<Real>& r, const Vector3<Real>& d,
                     const Vector3<Real>& e) {
  const Real zero = 0;
  return (dot(n, r) + min(dot(n, e), zero)) - max(dot(n, d), zero);
}

template <class Real>
SeparationAs<Real> separation(const CapsuleShape<Real>& a, const CapsuleShape<Real>& b,
                              const PairPose<Real>& pose) {
  using Vector = Vector3<Real>;
  using Tolerance = CoreTolerance<Real>;
  const Rotation<Real> turn_a = rotation_of(pose.a);
  const Rotation<Real> turn_b = rotation_of(pose.b);
  const Vector p = rotate(turn_a, a.a);
  const Vector q = rotate(turn_b, b.a) + pose.d;
  const Vector d = rotate(turn_a, Vector(a.b - a.a));
  const Vector e = rotate(turn_b, Vector(b.b - b.a));
  const Vector r = q - p;
  const NearestOfSegments<Real> near = nearest_of_segments(r, d, e);

  auto [way, is_across] = way_between(near);
  const Real height = dot(near.delta, way);
  if (is_across && height < 0) way = -way;
  const Real length = std::sqrt(dot(way, way));
  const Real to_unit = 1 / length;
  const Real distance = is_across ? std::fabs(height) * to_unit : length;
  const bool coincide = !is_across && distance <= Real(kCoincident);
  const Vector normal = coincide ? normal_of_touching(near) : Vector(way * to_unit);

  const Vector core_a = p + d * near.s;
  const Vector core_b = q + e * near.t;
  SeparationAs<Real> result = grown(core_a, core_b, normal, distance, a.radius, b.radius, pose);
  const bool is_tilted = gap_of_segments(normal, r, d, e) < distance - Tolerance::kTilt;
  result.is_unsure = result.is_unsure || coincide || is_tilted;
  if (coincide) result.status = Status::degenerate;
  return result;
}

}  // namespace carom::scalar
