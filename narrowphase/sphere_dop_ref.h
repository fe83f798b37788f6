// Sphere (A) against k-DOP (B), as polytopes.
#pragma once

#include "narrowphase/convex_ref.h"

namespace carom::reference {

template <class Real>
SeparationAs<Real> separation(const SphereShape<Real>& a, const DopShape<Real>& b,
                              const PairPose<Real>& pose) {
  return convex_separation(a, b, pose);
}

}  // namespace carom::reference
