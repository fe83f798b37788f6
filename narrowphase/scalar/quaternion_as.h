// Quaternions as the scalar tests read them.
#pragma once

#include <cmath>

#include "base/tolerances.h"
#include "narrowphase/scalar/scaled.h"

namespace carom::scalar {

// Scales q by a power of two if its squares could vanish or overflow.
template <class Real>  // inlined: a call would wait for numbers that were just stored
[[gnu::always_inline]] inline Quaternion<Real> quaternion_as(const Eigen::Vector4f& q) {
  const float norm = dot(q.head<3>().eval(), q.head<3>().eval()) + q.w() * q.w();
  Eigen::Vector4f scaled = q;
  if (!(norm >= kLeastSquaredNorm && norm <= kGreatestSquaredNorm)) {
    scaled *= scale_of(max(largest_component<float>(q.head<3>()), std::fabs(q.w()))).down;
  }
  return {scaled.head<3>().cast<Real>(), Real(scaled.w())};
}

}  // namespace carom::scalar
