// Hulls and triangles (A) against cylinder (B): the widest gap along the directions in which two
// features face each other.
//
// Source: see narrowphase/hulls/solid_cylinder_scalar.h.
#pragma once

#include "narrowphase/doubles/convex.h"
#include "narrowphase/features/round_tolerances.h"
#include "narrowphase/hulls/solid_cylinder_scalar.h"

namespace carom::scalar {

// Whether a point that lies in front of no face by more than a little lies near the shape.
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

// k-DOPs are left to double precision: their edges are not stored.
inline bool has_kernel(const Solid& solid) { return solid.is_known() && !solid.dop; }

template <class S>
Separation solid_cylinder_separation(const S& shape, const CylinderShape<float>& cylinder,
                                     const PairPose<float>& pose) {
  const SolidOf<S> solid_of_shape(shape);
  const Solid& solid = solid_of_shape.view();
  if (!has_kernel(solid)) return not_in_float<float>();
  const Rotation<float> turn = rotation_of(pose.a);
  const PlacedCylinder placed = {rotate_back(turn, pose.d),
                                 rotate_back(turn, rotation_of(pose.b).z), cylinder.half_length,
                                 cylinder.radius};
  const SolidContact contact = find_solid_contact(solid, placed, is_blunt(shape));
  return separation_of(contact, turn, {0, 0, 0}, cylinder.rounding, pose.d);
}

}  // namespace carom::scalar
