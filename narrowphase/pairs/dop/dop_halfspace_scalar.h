// K-DOP (A) against half-space (B): the lowest corner, or the middle of the edge or face that lies
// flat.
//
// Source: C. Ericson, Real-Time Collision Detection, 2005, section 5.2.3.
#pragma once

#include "narrowphase/doubles/convex.h"

namespace carom::scalar {

template <class Real>
SeparationAs<Real> separation(const DopShape<Real>& dop, const HalfspaceShape<Real>& halfspace,
                              const PairPose<Real>& pose) {
  if constexpr (std::is_same_v<Real, float>) {
    return not_in_float<float>();
  } else {
    const Plane<Real> plane = plane_of(halfspace, pose.b, pose.d);
    return points_over_plane(plane, polytope_of(dop, pose.a).points, dop.size(), pose.d);
  }
}

}  // namespace carom::scalar
