// Capsule (A) against a box along the world axes (B): the capsule's segment, seen from the centre
// of the box.
#pragma once

#include "narrowphase/features/rounded_scalar.h"
#include "narrowphase/features/segment_box_scalar.h"
#include "narrowphase/scalar/shapes.h"

namespace carom::scalar {

template <class Real>
SeparationAs<Real> separation(const CapsuleShape<Real>& capsule, const AabbShape<Real>& box,
                              const PairPose<Real>& pose) {
  const Rotation<Real> turn = rotation_of(pose.a);
  const Vector3<Real> centre = ((pose.d + box.lower) + (pose.d + box.upper)) * Real(0.5);
  const Vector3<Real> half = (box.upper - box.lower) * Real(0.5);
  const Vector3<Real> start = rotate(turn, capsule.a) - centre;
  const Vector3<Real> d = rotate<Real>(turn, capsule.b - capsule.a);
  const BoxContact<Real> contact = segment_box(start, d, half);

  SeparationAs<Real> result =
      grown<Real>(contact.on_other + centre, contact.on_box + centre, -contact.normal,
                  contact.separation, capsule.radius, 0, pose);
  result.is_unsure = result.is_unsure || contact.is_unsure;
  return result;
}

}  // namespace carom::scalar
