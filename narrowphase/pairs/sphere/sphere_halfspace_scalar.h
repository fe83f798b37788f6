// Sphere (A) against half-space (B): the height of the centre over the plane.
//
// Source: C. Ericson, Real-Time Collision Detection, 2005, section 5.2.2.
#pragma once

#include "narrowphase/features/halfspace_scalar.h"

namespace carom::scalar {

template <class Real>
SeparationAs<Real> separation(const SphereShape<Real>& sphere,
                              const HalfspaceShape<Real>& halfspace, const PairPose<Real>& pose) {
  const Plane<Real> plane = plane_of(halfspace, pose.b, pose.d);
  const Real separation = -plane.height - sphere.radius;
  const Vector3<Real> lowest = plane.normal * -sphere.radius;
  return over_plane(plane, separation, lowest, sphere.size(), pose.d);
}

}  // namespace carom::scalar
