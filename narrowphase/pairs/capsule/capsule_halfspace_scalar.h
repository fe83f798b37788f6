// Capsule (A) against half-space (B): the lower end of the segment, the middle of one that lies
// flat.
//
// Source: C. Ericson, Real-Time Collision Detection, 2005, section 5.2.2.
#pragma once

#include "narrowphase/features/halfspace_scalar.h"

namespace carom::scalar {

template <class Real>
SeparationAs<Real> separation(const CapsuleShape<Real>& capsule,
                              const HalfspaceShape<Real>& halfspace, const PairPose<Real>& pose) {
  const Plane<Real> plane = plane_of(halfspace, pose.b, pose.d);
  const Rotation<Real> turn = rotation_of(pose.a);
  const Vector3<Real> a = rotate(turn, capsule.a);
  const Vector3<Real> b = rotate(turn, capsule.b);
  const Real height_a = dot(plane.normal, a);
  const Real height_b = dot(plane.normal, b);
  const Real separation = (min(height_a, height_b) - plane.height) - capsule.radius;

  Vector3<Real> core = height_a < height_b ? a : b;
  const bool lies_flat = std::fabs(height_a - height_b) <= Real(kLyingFlat) * capsule.size();
  if (lies_flat) core = (a + b) * Real(0.5);
  const Vector3<Real> lowest = core - plane.normal * capsule.radius;
  return over_plane(plane, separation, lowest, capsule.size(), pose.d);
}

}  // namespace carom::scalar
