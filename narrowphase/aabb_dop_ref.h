// Aabb (A) against k-DOP (B), as cores.
#pragma once

#include "narrowphase/core_separation_ref.h"

namespace carom::reference {

template <class Real>
SeparationAs<Real> separation(const AabbShape<Real>& a, const DopShape<Real>& b,
                              const PairPose<Real>& pose) {
  return separation_of_cores(a, b, pose);
}

}  // namespace carom::reference
