// Box along the world axes (A) against cylinder (B): the widest gap along the directions of two
// features.
//
// Source: see narrowphase/features/box_cylinder_scalar.h.
#pragma once

#include "narrowphase/features/box_cylinder_scalar.h"
#include "narrowphase/scalar/shapes.h"

namespace carom::scalar {

// Subtracts both corners before it takes the mean, so that a box far from its position loses no
// digits.
inline Separation separation(const AabbShape<float>& aabb, const CylinderShape<float>& cylinder,
                             const PairPose<float>& pose) {
  const Vector3f middle = ((pose.d - aabb.lower) + (pose.d - aabb.upper)) * 0.5f;
  const CylinderAtBox at_box((aabb.upper - aabb.lower) * 0.5f, middle,
                             {rotation_of(pose.b).z, cylinder.half_length, cylinder.radius});
  const SolidContact contact = contact_along(at_box, find_box_way(at_box));
  const Vector3f centre = (aabb.lower + aabb.upper) * 0.5f;
  const Rotation<float> world = {Vector3f::UnitX(), Vector3f::UnitY(), Vector3f::UnitZ()};
  return separation_of(contact, world, centre, cylinder.rounding, pose.d);
}

}  // namespace carom::scalar
