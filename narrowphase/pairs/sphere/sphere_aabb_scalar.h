// Sphere (A) against a box along the world axes (B): the nearest point of the box to the centre.
//
// Source: C. Ericson, Real-Time Collision Detection, 2005, sections 5.1.3 (the point of a box that
// is closest to a point) and 5.2.5 (sphere against box). For a centre inside the box that point is
// the centre itself; then the nearest face gives the penetration direction.
#pragma once

#include "narrowphase/scalar/length.h"
#include "narrowphase/scalar/near_touch.h"
#include "narrowphase/scalar/scaled.h"
#include "narrowphase/scalar/separation.h"

namespace carom::scalar {

// A centre inside the box leaves through the nearest face; ties go to the first axis and its lower
// side. `closest` equals `centre`, but for the signs of zeros.
inline Separation sphere_inside_aabb(float radius, const Vector3f& lower, const Vector3f& upper,
                                     const Vector3f& centre, const Vector3f& closest) {
  const Vector3f below = centre - lower;
  const Vector3f above = upper - centre;
  const Vector3f exit(min(below.x(), above.x()), min(below.y(), above.y()),
                      min(below.z(), above.z()));
  const int axis = exit.x() <= exit.y() && exit.x() <= exit.z() ? 0 : exit.y() <= exit.z() ? 1 : 2;
  const bool leaves_upwards = above[axis] < below[axis];

  // The normal points from the sphere into the box, against the penetration direction.
  Vector3f normal = Vector3f::Zero();
  normal[axis] = leaves_upwards ? -1.0f : 1.0f;
  Vector3f on_face = closest;
  on_face[axis] = leaves_upwards ? upper[axis] : lower[axis];
  return {-exit[axis] - radius, normal, radius * normal, on_face};
}

// Only the separation, in double precision.
inline float sphere_aabb_near_touch(float radius, const Vector3f& lower, const Vector3f& upper,
                                    const Vector3d& centre) {
  Vector3d delta;
  double exit = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const double low = lower[i], high = upper[i];
    const double closest = centre[i] < low ? low : centre[i] > high ? high : centre[i];
    delta[i] = closest - centre[i];
    exit = std::fmin(exit, std::fmin(centre[i] - low, high - centre[i]));
  }
  const double squared_distance = squared_length(delta);
  if (squared_distance > 0) return gap_to_ball(squared_distance, radius);
  return round_separation(0 - (exit + radius));
}

// `lower` and `upper` are relative to the position of B; `d` is that position relative to the
// sphere's centre, `exact_d` the same before it was rounded.
inline Separation sphere_aabb(float radius, const Vector3f& lower, const Vector3f& upper,
                              const Vector3f& d, const Vector3d& exact_d) {
  const Vector3f centre = -d;
  Vector3f closest;
  for (int i = 0; i < 3; ++i) closest[i] = min(max(centre[i], lower[i]), upper[i]);
  const Vector3f delta = closest - centre;

  const Length distance = length_of(delta.unaryExpr(&clamp_to_finite));
  Separation result = distance.is_zero ? sphere_inside_aabb(radius, lower, upper, centre, closest)
                                       : Separation{distance.length - radius, distance.direction,
                                                    radius * distance.direction, closest};
  if (is_near_touch(result.separation, largest_component(d) + radius)) {
    result.separation = sphere_aabb_near_touch(radius, lower, upper, -exact_d);
  }
  return result;
}

}  // namespace carom::scalar
