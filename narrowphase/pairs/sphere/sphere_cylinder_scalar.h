// Sphere (A) against cylinder (B): the centre beside a rectangle, in the plane through the axis.
//
// Source: as for a box, C. Ericson, Real-Time Collision Detection, 2005, section 5.1.4. A centre
// inside leaves through the side or the nearer end, whichever is nearer.
#pragma once

#include "narrowphase/features/profile_scalar.h"
#include "narrowphase/scalar/shapes.h"

namespace carom::scalar {

// From a point at this distance from the axis, and this height over the middle.
inline ProfileWay way_from_cylinder(const CylinderShape<float>& cylinder, float from_axis,
                                    float height) {
  const float beyond_side = from_axis - cylinder.radius;
  const float beyond_cap = std::fabs(height) - cylinder.half_length;
  const auto upwards = [height](float axial) { return height < 0 ? -axial : axial; };
  const float inside = max(beyond_side, beyond_cap);
  if (inside <= 0) {
    const bool by_cap = beyond_cap > beyond_side;
    return {inside, by_cap ? 0.0f : 1.0f, upwards(by_cap ? 1.0f : 0.0f)};
  }
  const float aside = max(beyond_side, 0.0f), above = max(beyond_cap, 0.0f);
  const float distance = std::sqrt(aside * aside + above * above);
  const float to_unit = 1 / distance;
  return {distance, aside * to_unit, upwards(above * to_unit)};
}

inline Separation separation(const SphereShape<float>& sphere, const CylinderShape<float>& cylinder,
                             const PairPose<float>& pose) {
  const Rotation<float> turn = rotation_of(pose.b);
  const Vector3<float> centre = rotate_back<float>(turn, -pose.d);
  const WayOut way = way_out_of_profile(centre, [&cylinder](float from_axis, float height) {
    return way_from_cylinder(cylinder, from_axis, height);
  });
  return ball_separation(centre, sphere.radius, cylinder.rounding, turn, way);
}

}  // namespace carom::scalar
