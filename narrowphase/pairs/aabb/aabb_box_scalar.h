// Box along the world axes (A) against an oriented box (B): fifteen separating axes.
#pragma once

#include "narrowphase/features/boxes.h"
#include "narrowphase/scalar/shapes.h"

namespace carom::scalar {

template <class Real>
SeparationAs<Real> separation(const AabbShape<Real>& a, const BoxShape<Real>& b,
                              const PairPose<Real>& pose) {
  const Vector3<Real> half = (a.upper - a.lower) * Real(0.5);
  // Subtracts both corners before it takes the mean, so that a box far from its position loses no
  // digits.
  const Vector3<Real> centre = ((pose.d - a.lower) + (pose.d - a.upper)) * Real(0.5);
  const Rotation<Real> world{Vector3<Real>::UnitX(), Vector3<Real>::UnitY(),
                             Vector3<Real>::UnitZ()};
  return separation_of_boxes<Real>({centre, rotation_of(pose.b), half, b.half}, world,
                                   (a.lower + a.upper) * Real(0.5));
}

}  // namespace carom::scalar
