// Hull (A) against half-space (B): the lowest point, or the middle of the edge or face that lies
// flat.
//
// Source: C. Ericson, Real-Time Collision Detection, 2005, section 5.2.3.
#pragma once

#include <vector>

#include "narrowphase/doubles/convex.h"
#include "narrowphase/doubles/core_separation.h"

namespace carom::scalar {

template <class Real>
SeparationAs<Real> separation(const HullShape<Real>& hull, const HalfspaceShape<Real>& halfspace,
                              const PairPose<Real>& pose) {
  if constexpr (std::is_same_v<Real, float>) {
    return not_in_float<float>();
  } else {
    Core& core = core_pair_of_thread().a;
    make_core(hull, pose.a, Vector3d::Zero(), core);
    thread_local std::vector<Vector3d> points;
    points.clear();
    for (size_t i = 0; i < core.size(); ++i) points.push_back(eigen_vector(core.point(i)));
    const Plane<Real> plane = plane_of(halfspace, pose.b, pose.d);
    return points_over_plane(plane, points, hull.size(), pose.d);
  }
}

}  // namespace carom::scalar
