// Sphere (A) against cone (B): the centre beside a triangle, in the plane through the axis.
//
// Source: the nearest point of a segment, C. Ericson, Real-Time Collision Detection, 2005, section
// 5.1.2. A centre inside leaves through the side or the base, whichever is nearer.
#pragma once

#include "narrowphase/features/profile_scalar.h"
#include "narrowphase/features/round_tolerances.h"
#include "narrowphase/scalar/shapes.h"

namespace carom::scalar {

// From a point at this distance from the axis, and this height over the middle.
inline ProfileWay way_from_cone(const ConeShape<float>& cone, float from_axis, float height) {
  const float rise = cone.half_length + cone.half_length;
  const float squared = cone.radius * cone.radius + rise * rise;
  const float to_unit = 1 / std::sqrt(max(squared, kLeastSlant));
  // The normal of the side; the side leads from the rim along (-out_axial, out_radial).
  const float out_radial = rise * to_unit, out_axial = cone.radius * to_unit;
  const float from_rim = from_axis - cone.radius;
  const float over_base = height + cone.half_length;
  const float over_side = from_rim * out_radial + over_base * out_axial;
  const float along = over_base * out_radial - from_rim * out_axial;
  const float beyond_end = along - clamp(along, 0.0f, squared * to_unit);

  const bool is_below = over_base < 0;
  const bool is_inside = !is_below && over_side <= 0;
  const bool by_base = (is_below && from_rim <= 0) || (is_inside && over_base < -over_side);
  if (by_base) return {-over_base, 0, -1};
  if (is_inside) return {over_side, out_radial, out_axial};
  const float distance = std::sqrt(over_side * over_side + beyond_end * beyond_end);
  const float from_side = 1 / distance;
  return {distance, (out_radial * over_side - out_axial * beyond_end) * from_side,
          (out_axial * over_side + out_radial * beyond_end) * from_side};
}

// float32 does not know the slope of a cone that is much smaller than the pair.
inline Separation separation(const SphereShape<float>& sphere, const ConeShape<float>& cone,
                             const PairPose<float>& pose) {
  const Rotation<float> turn = rotation_of(pose.b);
  const Vector3<float> centre = rotate_back<float>(turn, -pose.d);
  WayOut way = way_out_of_profile(centre, [&cone](float from_axis, float height) {
    return way_from_cone(cone, from_axis, height);
  });
  way.is_vague = way.is_vague || max(cone.radius, cone.half_length) <= kSmallProfile;
  return ball_separation(centre, sphere.radius, cone.rounding, turn, way);
}

}  // namespace carom::scalar
