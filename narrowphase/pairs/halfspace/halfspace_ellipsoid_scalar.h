// Half-space (A) against ellipsoid (B): the point of the surface that faces the plane.
//
// Source: see round_over_plane_scalar.h.
#pragma once

#include "narrowphase/pairs/halfspace/round_over_plane_scalar.h"

namespace carom::scalar {

template <class Real>
LowestPoint<Real> lowest_point(const EllipsoidShape<Real>& ellipsoid, const Vector3<Real>& n,
                               Real flat) {
  const Vector3<Real> reach = ellipsoid.semi_axes.cwiseProduct(n);
  const Real height = std::sqrt(dot(reach, reach));
  const Real share = height + height <= flat ? Real(0) : -1 / height;
  return {-height, ellipsoid.semi_axes.cwiseProduct(reach * share)};
}

}  // namespace carom::scalar
