// Sphere (A) against box (B): the nearest point of the box to the centre, in its frame.
//
// Source: C. Ericson, Real-Time Collision Detection, 2005, sections 5.1.4 and 5.2.5. A centre
// inside the box leaves through the nearest face.
#pragma once

#include <type_traits>

#include "narrowphase/features/axis_search_scalar.h"
#include "narrowphase/features/rounded_scalar.h"
#include "narrowphase/scalar/shapes.h"

namespace carom::scalar {

// Ties go to the first axis and its lower side. Normals lead from the box to the centre.
template <class Real>
BoxAxis<Real> way_out_of_box(const Vector3<Real>& centre, const Vector3<Real>& half) {
  int axis = 0;
  for (int i = 1; i < 3; ++i) {
    if (half[i] - std::fabs(centre[i]) < half[axis] - std::fabs(centre[axis])) axis = i;
  }
  Vector3<Real> normal = Vector3<Real>::Zero();
  normal[axis] = centre[axis] > 0 ? 1 : -1;
  return {-(half[axis] - std::fabs(centre[axis])), normal};
}

template <class Real>
SeparationAs<Real> separation(const SphereShape<Real>& sphere, const BoxShape<Real>& box,
                              const PairPose<Real>& pose) {
  const Rotation<Real> turn = rotation_of(pose.b);
  const Vector3<Real> centre = rotate_back<Real>(turn, -pose.d);
  const Vector3<Real> way = beyond(centre, box.half);
  const Real distance = std::sqrt(dot(way, way));
  // In double, a vector whose square vanishes counts as zero.
  const bool inside =
      largest_component(way) == 0 || (std::is_same_v<Real, double> && distance == 0);

  const BoxAxis<Real> out =
      inside ? way_out_of_box(centre, box.half) : BoxAxis<Real>{distance, way * (1 / distance)};
  const Vector3<Real> on_box =
      inside ? Vector3<Real>(centre - out.normal * out.gap) : Vector3<Real>(centre - way);
  SeparationAs<Real> result;
  result.separation = out.gap - sphere.radius;
  result.normal = -rotate(turn, out.normal);
  result.arm_a = result.normal * sphere.radius;
  result.arm_b = rotate(turn, on_box);
  // The squares of so short a vector vanish.
  result.is_unsure = is_near_touch(result.separation) || (!inside && distance <= Real(kCoincident));
  return result;
}

}  // namespace carom::scalar
