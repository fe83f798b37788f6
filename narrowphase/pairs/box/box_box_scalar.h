// Oriented box (A) against oriented box (B): fifteen separating axes.
#pragma once

#include "narrowphase/features/boxes.h"
#include "narrowphase/scalar/shapes.h"

namespace carom::scalar {

template <class Real>
SeparationAs<Real> separation(const BoxShape<Real>& a, const BoxShape<Real>& b,
                              const PairPose<Real>& pose) {
  const Rotation<Real> turn_a = rotation_of(pose.a);
  const BoxPair<Real> boxes{rotate_back(turn_a, pose.d),
                            rotation_of(relative_rotation(pose.a, pose.b)), a.half, b.half};
  return separation_of_boxes<Real>(boxes, turn_a, Vector3<Real>::Zero());
}

}  // namespace carom::scalar
