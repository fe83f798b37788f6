// Hull (A) against hull (B), as cores.
#pragma once

#include "narrowphase/core_separation_ref.h"

namespace carom::reference {

template <class Real>
SeparationAs<Real> separation(const HullShape<Real>& a, const HullShape<Real>& b,
                              const PairPose<Real>& pose) {
  return separation_of_cores(a, b, pose);
}

}  // namespace carom::reference
