// Aabb (A) against hull (B), as cores.
#pragma once

#include "narrowphase/hull_separation_ref.h"

namespace carom::reference {

template <class Real>
SeparationAs<Real> separation(const AabbShape<Real>& a, const HullShape<Real>& b,
                              const PairPose<Real>& pose) {
  return separation_with_hull(a, b, pose);
}

}  // namespace carom::reference
