// K-DOP (A) against triangle (B), as polytopes.
#pragma once

#include "narrowphase/convex_ref.h"

namespace carom::reference {

template <class Real>
SeparationAs<Real> separation(const DopShape<Real>& a, const TriangleShape<Real>& b,
                              const PairPose<Real>& pose) {
  return convex_separation(a, b, pose);
}

}  // namespace carom::reference
