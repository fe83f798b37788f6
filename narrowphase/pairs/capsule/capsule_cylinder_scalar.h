// Capsule (A) against cylinder (B): the capsule's segment against the cylinder, as two cylinders.
//
// Source: see narrowphase/features/cylinders_scalar.h.
#pragma once

#include "narrowphase/features/cylinders_scalar.h"
#include "narrowphase/features/round_tolerances.h"
#include "narrowphase/scalar/separation.h"
#include "narrowphase/scalar/shapes.h"

namespace carom::scalar {

// A capsule that is nearly a ball has no good axis.
inline Separation separation(const CapsuleShape<float>& capsule,
                             const CylinderShape<float>& cylinder, const PairPose<float>& pose) {
  const Rotation<float> turn = rotation_of(pose.a);
  const Vector3<float> way = rotate<float>(turn, capsule.b - capsule.a) * 0.5f;
  const Vector3<float> middle = rotate<float>(turn, capsule.a + capsule.b) * 0.5f;
  const float length = std::sqrt(dot(way, way));
  const AxialCore core_a{way * (1 / max(length, kLeastRim)), length, 0};
  const AxialCore core_b{rotation_of(pose.b).z, cylinder.half_length, cylinder.radius};
  const CylinderContact contact = cylinder_contact(core_a, core_b, pose.d - middle);
  Separation result;
  result.separation = contact.separation - (capsule.radius + cylinder.rounding);
  result.normal = contact.normal;
  result.arm_a = (middle + contact.on_a) + contact.normal * capsule.radius;
  result.arm_b = (result.arm_a + contact.normal * result.separation) - pose.d;
  result.is_unsure =
      !(contact.is_sure && length >= kShortAxis && std::fabs(result.separation) > kSureGap);
  return result;
}

}  // namespace carom::scalar
