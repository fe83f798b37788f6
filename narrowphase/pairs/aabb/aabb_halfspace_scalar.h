// Axis-aligned box (A) against half-space (B): the lowest corner, or the middle of the edge or face
// that lies flat.
//
// Source: C. Ericson, Real-Time Collision Detection, 2005, section 5.2.3.
#pragma once

#include "narrowphase/features/halfspace_scalar.h"

namespace carom::scalar {

template <class Real>
SeparationAs<Real> separation(const AabbShape<Real>& box, const HalfspaceShape<Real>& halfspace,
                              const PairPose<Real>& pose) {
  const Plane<Real> plane = plane_of(halfspace, pose.b, pose.d);
  Vector3<Real> corner, lowest;
  for (int i = 0; i < 3; ++i) {
    corner[i] = plane.normal[i] > 0 ? box.lower[i] : box.upper[i];
    const Real half = (box.upper[i] - box.lower[i]) * Real(0.5);
    const bool lies_flat = std::fabs(plane.normal[i]) * half <= Real(kLyingFlat) * box.size();
    lowest[i] = lies_flat ? (box.lower[i] + box.upper[i]) * Real(0.5) : corner[i];
  }
  const Real separation = dot(plane.normal, corner) - plane.height;
  return over_plane(plane, separation, lowest, box.size(), pose.d);
}

}  // namespace carom::scalar
