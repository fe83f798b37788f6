// Half-space (A) against triangle (B): the lowest corner, or the middle of the edge or face that
// lies flat.
//
// Source: C. Ericson, Real-Time Collision Detection, 2005, section 5.2.3.
#pragma once

#include "narrowphase/doubles/special_triangle.h"
#include "narrowphase/features/halfspace_scalar.h"

namespace carom::scalar {

template <class Real>
SeparationAs<Real> separation(const HalfspaceShape<Real>& halfspace,
                              const TriangleShape<Real>& triangle, const PairPose<Real>& pose) {
  if (triangle.is_special()) return special_triangle(halfspace, triangle, pose);
  const Vector3<Real> d = -pose.d;
  const Plane<Real> plane = plane_of(halfspace, pose.a, d);
  const Rotation<Real> turn = rotation_of(pose.b);
  std::array<Vector3<Real>, 3> corners;
  for (int i = 0; i < 3; ++i) corners[i] = rotate(turn, triangle.corners[i]);
  return flipped(points_over_plane<Real>(plane, corners, triangle.size(), d));
}

}  // namespace carom::scalar
