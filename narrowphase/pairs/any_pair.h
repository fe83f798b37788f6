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

// Runs the test in scaled units; takes the shapes in either order.
template <class Real, class A, class B>
SeparationAs<Real> separation_of(const A& a, const B& b, const PairPose<Real>& pose) {
  const auto shape_a = shape_as<Real>(a);
  const auto shape_b = shape_as<Real>(b);
  const auto separate = [](const auto& x, const auto& y, const PairPose<Real>& p) {
    return separation(x, y, p);
  };
  if constexpr (HasSeparation<decltype(shape_a), decltype(shape_b), Real>) {
    return in_scaled_units<Real>(shape_a, shape_b, pose, separate);
  } else if constexpr (HasSeparation<decltype(shape_b), decltype(shape_a), Real>) {
    return flipped(in_scaled_units<Real>(shape_b, shape_a, flipped(pose), separate));
  } else {
    return {};  // no test: carom::supports() is false for such pairs
  }
}

template <class Real>
SeparationAs<Real> separation_of(const Shape& a, const Shape& b, const PairPose<Real>& pose) {
  return std::visit([&](const auto& x, const auto& y) { return separation_of<Real>(x, y, pose); },
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
