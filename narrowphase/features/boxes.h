// The separation of two boxes: overlapping ones along the best separating axis, separate ones by
// their distance.
#pragma once

#include "narrowphase/features/boxes_distance.h"
#include "narrowphase/features/rounded_scalar.h"

namespace carom::scalar {

// `turn_a` turns the frame of A to the world; `centre_a` is its centre relative to its position.
template <class Real>
SeparationAs<Real> separation_of_boxes(const BoxPair<Real>& p, const Rotation<Real>& turn_a,
                                       const Vector3<Real>& centre_a) {
  const SeparatingAxis<Real> axis = best_axis(p);
  const BoxDistance<Real> result =
      axis.gap > 0 ? distance_of(p, axis)
                   : BoxDistance<Real>{axis.gap, axis.normal, witness_along(p, axis)};
  SeparationAs<Real> s;
  s.separation = result.distance;
  s.normal = rotate(turn_a, result.normal);
  s.arm_a = rotate(turn_a, result.witness.on_a) + centre_a;
  s.arm_b = rotate<Real>(turn_a, result.witness.on_b - p.centre);
  s.is_unsure = is_near_touch(axis.gap) || result.witness.is_unsure;
  return s;
}

}  // namespace carom::scalar
