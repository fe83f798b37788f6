// Box (A) against triangle (B), in the frame of the box.
#pragma once

#include "narrowphase/doubles/special_triangle.h"
#include "narrowphase/features/box_triangle_core_scalar.h"

namespace carom::scalar {

template <class Real>
SeparationAs<Real> separation(const BoxShape<Real>& box, const TriangleShape<Real>& triangle,
                              const PairPose<Real>& pose) {
  if (triangle.is_special()) return special_triangle(box, triangle, pose);
  const Rotation<Real> turn = rotation_of(relative_rotation(pose.a, pose.b));
  const Rotation<Real> turn_box = rotation_of(pose.a);
  const PlacedTriangle<Real> placed(triangle, rotate_back(turn_box, pose.d),
                                    [&](const Vector3<Real>& v) { return rotate(turn, v); });
  const BoxContact<Real> contact = box_triangle(placed, box.half);

  SeparationAs<Real> result;
  result.separation = contact.separation;
  result.normal = rotate(turn_box, contact.normal);
  result.arm_a = rotate(turn_box, contact.on_box);
  result.arm_b = rotate(turn_box, contact.on_other) - pose.d;
  result.is_unsure = contact.is_unsure;
  return result;
}

}  // namespace carom::scalar
