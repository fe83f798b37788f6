// Box along the world axes (A) against an oriented box (B): fifteen separating axes.
#pragma once

#include "narrowphase/features/boxes.h"
#include "narrowphase/scalar/shapes.h"

namespace carom::scalar {

// Subtracts both corners before it takes the mean, so that a box far from its position loses no
// digits.
template <class Real>
PlacedBoxes<Real> placed_boxes(const AabbShape<Real>& a, const BoxShape<Real>& b,
                               const PairPose<Real>& pose) {
  const Vector3<Real> half = (a.upper - a.lower) * Real(0.5);
  const Vector3<Real> centre = ((pose.d - a.lower) + (pose.d - a.upper)) * Real(0.5);
  return {{centre, rotation_of(pose.b), half, b.half},
          {Vector3<Real>::UnitX(), Vector3<Real>::UnitY(), Vector3<Real>::UnitZ()},
          (a.lower + a.upper) * Real(0.5)};
}

template <class Real>
SeparationAs<Real> separation(const AabbShape<Real>& a, const BoxShape<Real>& b,
                              const PairPose<Real>& pose) {
  return separation_of_boxes(placed_boxes(a, b, pose));
}

}  // namespace carom::scalar
