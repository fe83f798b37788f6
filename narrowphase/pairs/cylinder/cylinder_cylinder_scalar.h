// Cylinder against cylinder: the widest gap along the directions in which two features face each
// other.
//
// Source: see narrowphase/features/cylinders_scalar.h.
#pragma once

#include "narrowphase/features/cylinders_scalar.h"
#include "narrowphase/scalar/separation.h"
#include "narrowphase/scalar/shapes.h"

namespace carom::scalar {

inline Separation separation(const CylinderShape<float>& a, const CylinderShape<float>& b,
                             const PairPose<float>& pose) {
  const AxialCore core_a{rotation_of(pose.a).z, a.half_length, a.radius};
  const AxialCore core_b{rotation_of(pose.b).z, b.half_length, b.radius};
  const CylinderContact contact = cylinder_contact(core_a, core_b, pose.d);
  Separation result;
  result.separation = contact.separation - (a.rounding + b.rounding);
  result.normal = contact.normal;
  result.arm_a = contact.on_a + contact.normal * a.rounding;
  result.arm_b = (result.arm_a + contact.normal * result.separation) - pose.d;
  result.is_unsure = !(contact.is_sure && std::fabs(result.separation) > kSureGap);
  return result;
}

}  // namespace carom::scalar
