// Sphere (A) against sphere (B): the distance of the centres. A point is a sphere of radius zero.
//
// Source: C. Ericson, Real-Time Collision Detection, 2005, section 4.3.1; the separation is the
// distance of the centres less both radii.
#pragma once

#include "narrowphase/scalar/length.h"
#include "narrowphase/scalar/near_touch.h"
#include "narrowphase/scalar/separation.h"

namespace carom::scalar {

// `d` is the centre of B relative to that of A, `exact_d` the same before it was rounded.
inline Separation sphere_sphere(float radius_a, float radius_b, const Vector3f& d,
                                const Vector3d& exact_d) {
  const Length distance = length_of(d);
  // The larger radius first: near touch it is at least half the distance, so the first difference
  // is exact (Sterbenz) and the second adds no more than its own rounding.
  float separation = (distance.length - max(radius_a, radius_b)) - min(radius_a, radius_b);
  if (is_near_touch(separation, distance.length)) {
    separation = gap_to_ball(squared_length(exact_d), double{radius_a} + double{radius_b});
  }
  // Concentric spheres separate equally well in every direction: +x, by convention.
  const Vector3f normal = distance.is_zero ? Vector3f(1, 0, 0) : distance.direction;
  return {separation, normal, radius_a * normal, -(radius_b * normal),
          distance.is_zero ? Status::degenerate : Status::ok};
}

}  // namespace carom::scalar
