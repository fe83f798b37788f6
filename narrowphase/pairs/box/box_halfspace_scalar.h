// Box (A) against half-space (B): the lowest corner, or the middle of the edge or face that lies
// flat.
//
// Source: C. Ericson, Real-Time Collision Detection, 2005, section 5.2.3.
#pragma once

#include "narrowphase/features/halfspace_scalar.h"

namespace carom::scalar {

template <class Real>
SeparationAs<Real> separation(const BoxShape<Real>& box, const HalfspaceShape<Real>& halfspace,
                              const PairPose<Real>& pose) {
  const Plane<Real> plane = plane_of(halfspace, pose.b, pose.d);
  const Rotation<Real> turn = rotation_of(pose.a);
  const Vector3<Real> slope = rotate_back(turn, plane.normal);
  const Vector3<Real> drop = slope.cwiseAbs().cwiseProduct(box.half);
  const Real separation = -((drop.x() + drop.y()) + drop.z()) - plane.height;

  Vector3<Real> lowest;  // in the frame of the box
  for (int i = 0; i < 3; ++i) {
    const bool lies_flat = drop[i] <= Real(kLyingFlat) * box.size();
    lowest[i] = lies_flat ? 0 : slope[i] > 0 ? -box.half[i] : box.half[i];
  }
  return over_plane(plane, separation, rotate(turn, lowest), box.size(), pose.d);
}

}  // namespace carom::scalar
