// Oriented box (A) against oriented box (B): fifteen separating axes.
#pragma once

#include "narrowphase/features/boxes.h"
#include "narrowphase/scalar/shapes.h"

namespace carom::scalar {

template <class Real>
PlacedBoxes<Real> placed_boxes(const BoxShape<Real>& a, const BoxShape<Real>& b,
                               const PairPose<Real>& pose) {
  const Rotation<Real> turn_a = rotation_of(pose.a);
  return {
      {rotate_back(turn_a, pose.d), rotation_of(relative_rotation(pose.a, pose.b)), a.half, b.half},
      turn_a,
      Vector3<Real>::Zero()};
}

template <class Real>
SeparationAs<Real> separation(const BoxShape<Real>& a, const BoxShape<Real>& b,
                              const PairPose<Real>& pose) {
  return separation_of_boxes(placed_boxes(a, b, pose));
}

}  // namespace carom::scalar
