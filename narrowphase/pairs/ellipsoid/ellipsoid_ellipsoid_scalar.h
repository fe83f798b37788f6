// Ellipsoid against ellipsoid: the direction with the widest gap, by Newton's method on the sphere.
//
// Source: see narrowphase/features/ellipsoids_scalar.h.
#pragma once

#include "narrowphase/features/ellipsoids_scalar.h"
#include "narrowphase/scalar/separation.h"
#include "narrowphase/scalar/shapes.h"

namespace carom::scalar {

inline Separation separation(const EllipsoidShape<float>& a, const EllipsoidShape<float>& b,
                             const PairPose<float>& pose) {
  const Rotation<float> turn_a = rotation_of(pose.a), turn_b = rotation_of(pose.b);
  const EllipsoidPair pair(a.semi_axes,
                           {rotate_back<float>(turn_a, turn_b.x * b.semi_axes.x()),
                            rotate_back<float>(turn_a, turn_b.y * b.semi_axes.y()),
                            rotate_back<float>(turn_a, turn_b.z * b.semi_axes.z())},
                           rotate_back(turn_a, pose.d));
  const EllipsoidContact contact = pair.find();
  Separation result;
  result.separation = contact.separation - (a.rounding + b.rounding);
  result.normal = rotate(turn_a, contact.normal);
  result.arm_a = rotate(turn_a, contact.on_a) + result.normal * a.rounding;
  result.arm_b = (result.arm_a + result.normal * result.separation) - pose.d;
  const bool have_width = has_width(a.semi_axes) && has_width(b.semi_axes);
  result.is_unsure = !(contact.is_sure && have_width && std::fabs(result.separation) > kSureGap);
  return result;
}

}  // namespace carom::scalar
