// Sphere (A) against k-DOP (B), as cores.
#pragma once

#include "narrowphase/doubles/core_separation.h"

namespace carom::scalar {

template <class Real>
SeparationAs<Real> separation(const SphereShape<Real>& a, const DopShape<Real>& b,
                              const PairPose<Real>& pose) {
  return separation_of_cores(a, b, pose);
}

}  // namespace carom::scalar
