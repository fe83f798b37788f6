// Half-space (A) against cone (B): the tip or the lowest point of the rim, or the middle of the
// line or disc that lies flat.
//
// Source: see round_over_plane_scalar.h.
#pragma once

#include "narrowphase/pairs/halfspace/round_over_plane_scalar.h"

namespace carom::scalar {

template <class Real>
LowestPoint<Real> lowest_point(const ConeShape<Real>& cone, const Vector3<Real>& n, Real flat) {
  const Real slope = std::sqrt(n.x() * n.x() + n.y() * n.y());
  const Real of_disc = cone.radius * slope;
  const Real of_tip = cone.half_length * n.z(), of_rim = -(of_disc + of_tip);
  const Real out = of_disc + of_disc <= flat ? Real(0) : -cone.radius / slope;
  const bool is_rim = of_rim < of_tip;
  const Vector3<Real> rim(n.x() * out, n.y() * out, -cone.half_length);
  const Vector3<Real> tip(0, 0, cone.half_length);
  const bool lies = std::fabs(of_rim - of_tip) <= flat;
  return {is_rim ? of_rim : of_tip, lies ? (rim + tip) * Real(0.5) : is_rim ? rim : tip};
}

}  // namespace carom::scalar
