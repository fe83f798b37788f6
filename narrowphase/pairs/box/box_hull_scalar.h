// Box (A) against hull (B), as cores.
#pragma once

#include "narrowphase/hulls/hull_separation.h"

namespace carom::scalar {

template <class Real>
SeparationAs<Real> separation(const BoxShape<Real>& a, const HullShape<Real>& b,
                              const PairPose<Real>& pose) {
  return separation_with_hull(a, b, pose);
}

}  // namespace carom::scalar
