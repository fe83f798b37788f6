// Hull (A) against half-space (B): the lowest point, or the mean of those that lie flat.
//
// Source: C. Ericson, Real-Time Collision Detection, 2005, section 5.2.3.
#pragma once

#include "narrowphase/features/halfspace_scalar.h"

namespace carom::scalar {

template <class Real>
SeparationAs<Real> separation(const HullShape<Real>& hull, const HalfspaceShape<Real>& halfspace,
                              const PairPose<Real>& pose) {
  const Plane<Real> plane = plane_of(halfspace, pose.b, pose.d);
  const Rotation<Real> turn = rotation_of(pose.a);
  const Vector3<Real> slope = rotate_back(turn, plane.normal);
  const auto points = hull.geometry->points();
  const auto scale = static_cast<Real>(hull.scale);
  const auto point = [&](size_t i) -> Vector3<Real> {
    return points[i].template cast<Real>() * scale;
  };

  Real least = dot(slope, point(0));
  for (size_t i = 1; i < points.size(); ++i) least = min(least, dot(slope, point(i)));
  const Real low = least + Real(kLyingFlat) * hull.size();
  Real weight = 0;
  Vector3<Real> sum = Vector3<Real>::Zero();
  for (size_t i = 0; i < points.size(); ++i) {
    if (!(dot(slope, point(i)) <= low)) continue;
    weight += 1;
    sum += point(i);
  }
  const Vector3<Real> lowest = rotate(turn, Vector3<Real>(sum * (1 / weight)));
  return over_plane<Real>(plane, least - plane.height, lowest, hull.size(), pose.d);
}

}  // namespace carom::scalar
