// Hull (A) against triangle (B), as cores.
#pragma once

#include "narrowphase/doubles/ruled_core.h"
#include "narrowphase/hulls/hull_separation.h"

namespace carom::scalar {

inline SeparationAs<double> core_separation(const HullShape<double>& a,
                                            const TriangleShape<double>& b,
                                            const PairPose<double>& pose, const CoreTest& test) {
  return b.is_special()
             ? ruled_hull(a, b, pose, test)
             : core_separation<HullShape<double>, TriangleShape<double>>(a, b, pose, test);
}

template <class Real>
SeparationAs<Real> separation(const HullShape<Real>& a, const TriangleShape<Real>& b,
                              const PairPose<Real>& pose) {
  return separation_with_hull(a, b, pose);
}

}  // namespace carom::scalar
