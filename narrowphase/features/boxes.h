// The separation of two boxes: overlapping ones along the best separating axis, separate ones by
// their distance.
#pragma once

#include "narrowphase/features/boxes_distance.h"
#include "narrowphase/features/rounded_scalar.h"

namespace carom::scalar {

// Two boxes in the frame of A, and that frame in the world.
template <class Real>
struct PlacedBoxes {
  BoxPair<Real> boxes;
  Rotation<Real> turn_a;
  Vector3<Real> centre_a;  // relative to A's position
};

template <class Real>
SeparationAs<Real> in_the_world(const PlacedBoxes<Real>& placed, const BoxDistance<Real>& found) {
  SeparationAs<Real> s;
  s.separation = found.distance;
  s.normal = rotate(placed.turn_a, found.normal);
  s.arm_a = rotate(placed.turn_a, found.witness.on_a) + placed.centre_a;
  s.arm_b = rotate<Real>(placed.turn_a, found.witness.on_b - placed.boxes.centre);
  return s;
}

template <class Real>
SeparationAs<Real> separation_of_boxes(const PlacedBoxes<Real>& placed) {
  const BoxPair<Real>& p = placed.boxes;
  const SeparatingAxis<Real> axis = best_axis(p);
  const BoxDistance<Real> found =
      axis.gap > 0 ? distance_of(p, axis)
                   : BoxDistance<Real>{axis.gap, axis.normal, witness_along(p, axis)};
  SeparationAs<Real> s = in_the_world(placed, found);
  s.is_unsure = is_near_touch(axis.gap) || found.witness.is_unsure;
  return s;
}

// As separation_of_boxes(), but separate boxes have the greatest gap along an axis, which their
// distance may exceed, and no nearest points. `has_points`: overlapping boxes have theirs.
template <class Real>
SeparationAs<Real> test_of_boxes(const PlacedBoxes<Real>& placed, bool has_points) {
  const SeparatingAxis<Real> axis = best_axis(placed.boxes);
  BoxDistance<Real> found{axis.gap, axis.normal, {placed.boxes.centre, placed.boxes.centre}};
  if (has_points && !(axis.gap > 0)) found.witness = witness_along(placed.boxes, axis);
  return in_the_world(placed, found);
}

}  // namespace carom::scalar
