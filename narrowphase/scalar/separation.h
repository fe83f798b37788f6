// The result of a scalar test of one pair.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "carom/results/contact.h"

namespace carom::scalar {

// Names, frames and signs as in Contact.
template <class Real>
struct SeparationAs {
  using Vector = Eigen::Matrix<Real, 3, 1>;

  Real separation;
  Vector normal;
  Vector arm_a;
  Vector arm_b;
  Status status = Status::ok;
  // Real could not decide: the pair lies within rounding of touching, or has no good normal in
  // Real.
  bool is_unsure = false;
};

using Separation = SeparationAs<float>;

struct Manifold {
  uint8_t count = 0;
  ManifoldPoints points{};
};

// The same result with A and B exchanged. A NaN (no answer) keeps its bits: its sign is not
// flipped.
template <class Real>
SeparationAs<Real> flipped(const SeparationAs<Real>& s) {
  const auto negated = [](Real x) { return std::isnan(x) ? x : -x; };
  return {s.separation, s.normal.unaryExpr(negated), s.arm_b, s.arm_a, s.status, s.is_unsure};
}

}  // namespace carom::scalar
