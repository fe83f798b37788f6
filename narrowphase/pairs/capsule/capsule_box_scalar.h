// Capsule (A) against box (B): the capsule's segment, in the frame of the box.
#pragma once

#include "narrowphase/features/rounded_scalar.h"
#include "narrowphase/features/segment_box_scalar.h"
#include "narrowphase/scalar/shapes.h"

namespace carom::scalar {

template <class Real>
SeparationAs<Real> separation(const CapsuleShape<Real>& capsule, const BoxShape<Real>& box,
                              const PairPose<Real>& pose) {
  const Rotation<Real> turn = rotation_of(relative_rotation(pose.b, pose.a));
  const Rotation<Real> turn_box = rotation_of(pose.b);
  const Vector3<Real> start = rotate(turn, capsule.a) + rotate_back<Real>(turn_box, -pose.d);
  const Vector3<Real> d = rotate<Real>(turn, capsule.b - capsule.a);
  const BoxContact<Real> contact = segment_box(start, d, box.half);

  const Vector3<Real> core_a = rotate(turn_box, contact.on_other) + pose.d;
  const Vector3<Real> core_b = rotate(turn_box, contact.on_box) + pose.d;
  SeparationAs<Real> result = grown<Real>(core_a, core_b, -rotate(turn_box, contact.normal),
                                          contact.separation, capsule.radius, 0, pose);
  result.is_unsure = result.is_unsure || contact.is_unsure;
  return result;
}

}  // namespace carom::scalar
