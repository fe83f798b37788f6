// Box (A) against cylinder (B): the widest gap along the directions of two features.
//
// Source: see narrowphase/features/box_cylinder_scalar.h.
#pragma once

#include "narrowphase/features/box_cylinder_scalar.h"
#include "narrowphase/scalar/shapes.h"

namespace carom::scalar {

inline Separation separation(const BoxShape<float>& box, const CylinderShape<float>& cylinder,
                             const PairPose<float>& pose) {
  const Rotation<float> turn = rotation_of(pose.a);
  const CylinderAtBox at_box(
      box.half, rotate_back(turn, pose.d),
      {rotate_back(turn, rotation_of(pose.b).z), cylinder.half_length, cylinder.radius});
  const SolidContact contact = contact_along(at_box, find_box_way(at_box));
  return separation_of(contact, turn, {0, 0, 0}, cylinder.rounding, pose.d);
}

}  // namespace carom::scalar
