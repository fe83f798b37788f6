// K-DOP (A) against hull (B), as cores.
#pragma once

#include "narrowphase/doubles/core_separation.h"

namespace carom::scalar {

template <class Real>
SeparationAs<Real> separation(const DopShape<Real>& a, const HullShape<Real>& b,
                              const PairPose<Real>& pose) {
  return separation_of_cores(a, b, pose);
}

}  // namespace carom::scalar
