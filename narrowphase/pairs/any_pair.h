// Runs the scalar test of any pair of shapes, chosen by their kinds.
#pragma once

#include <optional>
#include <variant>

#include "base/tolerances.h"
#include "narrowphase/pairs/all_pairs.h"
#include "narrowphase/scalar/scaled.h"

namespace carom::scalar {

// Whether a test exists for the shapes in this order.
template <class A, class B, class Real>
concept HasSeparation = requires(A a, B b, PairPose<Real> pose) {
  separation(a, b, pose);
};

// In scaled units. Tests are written, and compiled, for one order of the kinds alone, which is that
// of their codes.
template <class Real>
SeparationAs<Real> separation_of(const Shape& a, const Shape& b, const PairPose<Real>& pose) {
  if (kind_of(a) > kind_of(b)) return flipped(separation_of<Real>(b, a, flipped(pose)));
  const auto separate = [](const auto& x, const auto& y, const PairPose<Real>& p) {
    return separation(x, y, p);
  };
  return std::visit(
      [&](const auto& x, const auto& y) -> SeparationAs<Real> {
        const auto shape_x = shape_as<Real>(x);
        const auto shape_y = shape_as<Real>(y);
        if constexpr (HasSeparation<decltype(shape_x), decltype(shape_y), Real>) {
          return in_scaled_units<Real>(shape_x, shape_y, pose, separate);
        } else {
          return {};  // carom::supports() says which pairs there are
        }
      },
      a, b);
}

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
