// Box along the world axes (A) against triangle (B), seen from the centre of the box.
#pragma once

#include "narrowphase/doubles/special_triangle.h"
#include "narrowphase/features/box_triangle_core_scalar.h"

namespace carom::scalar {

template <class Real>
SeparationAs<Real> separation(const AabbShape<Real>& box, const TriangleShape<Real>& triangle,
                              const PairPose<Real>& pose) {
  if (triangle.is_special()) return special_triangle(box, triangle, pose);
  const Rotation<Real> turn = rotation_of(pose.b);
  const Vector3<Real> centre = (box.lower + box.upper) * Real(0.5);
  const Vector3<Real> half = (box.upper - box.lower) * Real(0.5);
  const Vector3<Real> position = ((pose.d - box.lower) + (pose.d - box.upper)) * Real(0.5);
  const PlacedTriangle<Real> placed(triangle, position,
                                    [&](const Vector3<Real>& v) { return rotate(turn, v); });
  const BoxContact<Real> contact = box_triangle(placed, half);

  SeparationAs<Real> result;
  result.separation = contact.separation;
  result.normal = contact.normal;
  result.arm_a = contact.on_box + centre;
  result.arm_b = contact.on_other - position;
  result.is_unsure = contact.is_unsure;
  return result;
}

}  // namespace carom::scalar
