// Half-space (A) against a round shape (B): the lowest point; where a disc or a line lies flat, its
// middle.
//
// Source: C. Ericson, Real-Time Collision Detection, 2005, sections 5.2.2 and 5.2.3 (the least
// height of a shape over a plane).
#pragma once

#include "narrowphase/features/halfspace_scalar.h"

namespace carom::scalar {

// Each shape has a lowest_point(shape, n, flat), in its frame and without its rounding. n is the
// unit normal out of the half-space; points that are less than `flat` higher count as well.
template <class Real>
struct LowestPoint {
  Real height;  // along n
  Vector3<Real> point;
};

template <class Round, class Real>
concept HasLowestPoint = requires(Round shape, Vector3<Real> n, Real flat) {
  lowest_point(shape, n, flat);
};

// lowest_of(n, flat): the lowest point of the shape.
template <class Real, class Round, class LowestOf>
SeparationAs<Real> round_over_plane(const HalfspaceShape<Real>& halfspace, const Round& shape,
                                    const PairPose<Real>& pose, const LowestOf& lowest_of) {
  const Vector3<Real> d = -pose.d;
  const Plane<Real> plane = plane_of(halfspace, pose.a, d);
  const Rotation<Real> turn = rotation_of(pose.b);
  const Real size = shape.size();
  const Vector3<Real> normal = rotate_back(turn, plane.normal);
  const LowestPoint<Real> low = lowest_of(normal, Real(kLyingFlat) * size);
  const Vector3<Real> lowest = rotate(turn, low.point) - plane.normal * shape.rounding;
  const Real separation = (low.height - plane.height) - shape.rounding;
  return flipped(over_plane(plane, separation, lowest, size, d));
}

template <class Real, class Round>
requires HasLowestPoint<Round, Real> SeparationAs<Real> separation(
    const HalfspaceShape<Real>& halfspace, const Round& shape, const PairPose<Real>& pose) {
  return round_over_plane(halfspace, shape, pose, [&shape](const Vector3<Real>& n, Real flat) {
    return lowest_point(shape, n, flat);
  });
}

}  // namespace carom::scalar
