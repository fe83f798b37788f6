// Half-space (A) against a round shape (B): the lowest point, of a disc or a side that lies flat
// its middle.
//
// Source: C. Ericson, Real-Time Collision Detection, 2005, section 5.2.2 and 5.2.3 (the least
// height of a shape over a plane).
#pragma once

#include "narrowphase/features/halfspace_scalar.h"

namespace carom::scalar {

// Of a shape without its rounding, in its frame.
//   lowest_point(shape, n, flat)  n: unit, out of the half-space; points that are less than `flat`
//                                 higher are as low
template <class Real>
struct LowestPoint {
  Real height;  // along n
  Vector3<Real> point;
};

template <class Real, class Round>
SeparationAs<Real> round_over_plane(const HalfspaceShape<Real>& halfspace, const Round& shape,
                                    const PairPose<Real>& pose) {
  const Vector3<Real> d = -pose.d;
  const Plane<Real> plane = plane_of(halfspace, pose.a, d);
  const Rotation<Real> turn = rotation_of(pose.b);
  const Real size = shape.size();
  const Vector3<Real> normal = rotate_back(turn, plane.normal);
  const LowestPoint<Real> low = lowest_point(shape, normal, Real(kLyingFlat) * size);
  const Vector3<Real> lowest = rotate(turn, low.point) - plane.normal * shape.rounding;
  const Real separation = (low.height - plane.height) - shape.rounding;
  return flipped(over_plane(plane, separation, lowest, size, d));
}

}  // namespace carom::scalar
