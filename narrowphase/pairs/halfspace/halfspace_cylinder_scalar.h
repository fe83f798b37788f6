// Half-space (A) against cylinder (B): the lowest point of a rim, or the middle of the line or disc
// that lies flat.
//
// Source: see round_over_plane_scalar.h.
#pragma once

#include "narrowphase/pairs/halfspace/round_over_plane_scalar.h"

namespace carom::scalar {

template <class Real>
LowestPoint<Real> lowest_point(const CylinderShape<Real>& cylinder, const Vector3<Real>& n,
                               Real flat) {
  const Real slope = std::sqrt(n.x() * n.x() + n.y() * n.y());
  const Real of_disc = cylinder.radius * slope;
  const Real of_axis = cylinder.half_length * std::fabs(n.z());
  const Real out = of_disc + of_disc <= flat ? Real(0) : -cylinder.radius / slope;
  const Real end =
      of_axis + of_axis <= flat ? Real(0) : -std::copysign(cylinder.half_length, n.z());
  return {-(of_disc + of_axis), {n.x() * out, n.y() * out, end}};
}

}  // namespace carom::scalar
