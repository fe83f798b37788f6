// K-DOP (A) against triangle (B): as cores, or as polytopes where the triangle has rules.
#pragma once

#include "narrowphase/doubles/convex.h"
#include "narrowphase/doubles/core_separation.h"

namespace carom::scalar {

inline SeparationAs<double> core_separation(const DopShape<double>& a,
                                            const TriangleShape<double>& b,
                                            const PairPose<double>& pose, const CoreTest& test) {
  return b.is_special()
             ? convex::separation_of(a, b, pose)
             : core_separation<DopShape<double>, TriangleShape<double>>(a, b, pose, test);
}

template <class Real>
SeparationAs<Real> separation(const DopShape<Real>& a, const TriangleShape<Real>& b,
                              const PairPose<Real>& pose) {
  return separation_of_cores(a, b, pose);
}

}  // namespace carom::scalar
