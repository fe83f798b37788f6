// Shapes with faces (A) against cylinder (B): the widest gap along the directions in which two
// features face each other.
//
// Source: see narrowphase/hulls/solid_cylinder_scalar.h.
#pragma once

#include "narrowphase/features/rounded_scalar.h"
#include "narrowphase/hulls/gjk_scalar.h"
#include "narrowphase/hulls/solid_cylinder_scalar.h"

namespace carom::scalar {

struct SolidCylinderTest {
  Separation separation = not_in_float<float>();
  bool is_proven = false;
};

// `find(solid, cylinder)` finds the best way out of the solid. Shapes without known faces and edges
// are left to double precision.
template <class S, class Find>
SolidCylinderTest test_solid_cylinder(const S& shape, const CylinderShape<float>& cylinder,
                                      const PairPose<float>& pose, const Find& find) {
  SolidCylinderTest test;
  const SolidOf<S> solid_of_shape(shape);
  const Solid& solid = solid_of_shape.view();
  if (!solid.is_known() || !solid.edges) return test;
  Rotation<float> turn{Vector3f::UnitX(), Vector3f::UnitY(), Vector3f::UnitZ()};
  if (solid.is_turned) turn = rotation_of(pose.a);
  const PlacedCylinder placed{rotate_back(turn, pose.d), rotate_back(turn, rotation_of(pose.b).z),
                              cylinder.half_length, cylinder.radius};
  const SolidContact contact = contact_along(solid, placed, find(solid, placed));
  Separation& s = test.separation;
  s.separation = contact.separation - cylinder.rounding;
  s.normal = rotate(turn, contact.normal);
  s.arm_a = rotate(turn, contact.on_solid);
  s.arm_b = (s.arm_a + s.normal * s.separation) - pose.d;
  s.is_unsure = !(contact.is_sure && std::fabs(s.separation) > kSureGap);
  test.is_proven = contact.is_proven;
  return test;
}

template <class S>
Separation solid_cylinder_separation(const S& shape, const CylinderShape<float>& cylinder,
                                     const PairPose<float>& pose) {
  return test_solid_cylinder(shape, cylinder, pose, find_solid_way).separation;
}

}  // namespace carom::scalar
