// Shapes with faces (A) against cylinder (B): the widest gap along the directions in which two
// features face each other.
//
// Source: see narrowphase/hulls/solid_cylinder_scalar.h.
#pragma once

#include "narrowphase/features/rounded_scalar.h"
#include "narrowphase/hulls/gjk_scalar.h"
#include "narrowphase/hulls/solid_cylinder_scalar.h"

namespace carom::scalar {

// Whether a point that lies before no face by more than a little lies near the shape.
inline bool is_blunt(const BoxShape<float>&) { return true; }
inline bool is_blunt(const AabbShape<float>&) { return true; }
inline bool is_blunt(const HullShape<float>& hull) {
  const HullGeometry::Balls& balls = hull.geometry->balls();
  return balls.inner >= kBlunt * balls.outer[3];
}
inline bool is_blunt(const TriangleShape<float>& triangle) {
  for (size_t i = 0; i < 3; ++i) {
    const Vector3f& corner = triangle.corners[i];
    const Vector3f u = triangle.corners[(i + 1) % 3] - corner;
    const Vector3f v = triangle.corners[(i + 2) % 3] - corner;
    const Vector3f across = cross(u, v);
    if (!(dot(across, across) >= (kBlunt * kBlunt) * (dot(u, u) * dot(v, v)))) return false;
  }
  return true;
}

// Others are left to double precision, and so are k-DOPs, whose edges are not stored.
template <class S>
bool has_kernel(const S& shape, const Solid& solid) {
  return solid.is_known() && !solid.dop && is_blunt(shape);
}

inline Rotation<float> turn_of(const Solid& solid, const PairPose<float>& pose) {
  if (solid.is_turned) return rotation_of(pose.a);
  return {Vector3f::UnitX(), Vector3f::UnitY(), Vector3f::UnitZ()};
}

// `turn`: of the solid.
inline PlacedCylinder placed_cylinder(const Rotation<float>& turn,
                                      const CylinderShape<float>& cylinder,
                                      const PairPose<float>& pose) {
  return {rotate_back(turn, pose.d), rotate_back(turn, rotation_of(pose.b).z), cylinder.half_length,
          cylinder.radius};
}

inline Separation separation_of(const SolidContact& contact, const Rotation<float>& turn,
                                const CylinderShape<float>& cylinder, const Vector3f& d) {
  Separation s;
  s.separation = contact.separation - cylinder.rounding;
  s.normal = unit(rotate(turn, contact.normal));
  s.arm_a = rotate(turn, contact.on_solid);
  s.arm_b = (s.arm_a + s.normal * s.separation) - d;
  s.is_unsure = !(contact.is_sure && std::fabs(s.separation) > kSureGap);
  return s;
}

template <class S>
Separation solid_cylinder_separation(const S& shape, const CylinderShape<float>& cylinder,
                                     const PairPose<float>& pose) {
  const SolidOf<S> solid_of_shape(shape);
  const Solid& solid = solid_of_shape.view();
  if (!has_kernel(shape, solid)) return not_in_float<float>();
  const Rotation<float> turn = turn_of(solid, pose);
  const PlacedCylinder placed = placed_cylinder(turn, cylinder, pose);
  const SolidContact contact = contact_along(solid, placed, find_solid_way(solid, placed));
  return separation_of(contact, turn, cylinder, pose.d);
}

}  // namespace carom::scalar
