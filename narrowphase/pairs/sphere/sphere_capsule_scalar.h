// Sphere (A) against capsule (B): the centre against the capsule's segment.
//
// Source: C. Ericson, Real-Time Collision Detection, 2005, section 4.5.1.
#pragma once

#include "narrowphase/features/rounded_scalar.h"
#include "narrowphase/features/segment_scalar.h"
#include "narrowphase/scalar/shapes.h"

namespace carom::scalar {

template <class Real>
SeparationAs<Real> separation(const SphereShape<Real>& sphere, const CapsuleShape<Real>& capsule,
                              const PairPose<Real>& pose) {
  const Rotation<Real> turn = rotation_of(pose.b);
  const Vector3<Real> a = rotate(turn, capsule.a) + pose.d;
  const Vector3<Real> b = rotate(turn, capsule.b) + pose.d;
  const Vector3<Real> centre = Vector3<Real>::Zero();
  const ToSegment<Real> nearest = nearest_on_segment(centre, a, b);
  const Real distance = std::sqrt(dot(nearest.delta, nearest.delta));

  // A centre on the segment may leave in any direction perpendicular to it.
  const Real least = nearest.is_across ? kNearSegment<Real> : Real(kCoincident);
  const bool coincide = distance <= least;
  const Vector3<Real> normal =
      coincide ? any_perpendicular<Real>(b - a) : Vector3<Real>(nearest.delta * (1 / distance));
  SeparationAs<Real> result =
      grown(centre, nearest.point, normal, distance, sphere.radius, capsule.radius, pose);
  result.is_unsure = result.is_unsure || coincide;
  if (coincide) result.status = Status::degenerate;
  return result;
}

}  // namespace carom::scalar
