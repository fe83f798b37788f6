// Shapes made of a core (point, segment, triangle, box) grown by a radius.
#pragma once

#include "base/tolerances.h"
#include "narrowphase/scalar/separation.h"
#include "narrowphase/scalar/vector.h"

namespace carom::scalar {

// Whether the separation, in scaled units, is within what rounding may have done to it.
template <class Real>
bool is_near_touch(Real separation) {
  return std::fabs(separation) <= Real(kNearTouchScaled);
}

// The result of two grown cores. `core_a` and `core_b` are the nearest points of the cores,
// relative to A, and `distance` apart.
template <class Real>
SeparationAs<Real> grown(const Vector3<Real>& core_a, const Vector3<Real>& core_b,
                         const Vector3<Real>& normal, Real distance, Real radius_a, Real radius_b,
                         const PairPose<Real>& pose) {
  SeparationAs<Real> result;
  result.separation = (distance - max(radius_a, radius_b)) - min(radius_a, radius_b);
  result.normal = normal;
  result.arm_a = core_a + normal * radius_a;
  result.arm_b = (core_b - pose.d) - normal * radius_b;
  result.is_unsure = is_near_touch(result.separation);
  return result;
}

}  // namespace carom::scalar
