// A hull against any convex shape but k-DOPs and half-spaces. float32 uses GJK and the depth
// search; rows that are unsure are computed again in double precision.
#pragma once

#include "narrowphase/doubles/core_separation.h"
#include "narrowphase/hulls/gjk_scalar.h"
#include "narrowphase/hulls/hull_steps_scalar.h"

namespace carom::scalar {

// Metres per unit of the scaled test; hulls store the scale.
template <class A, class B>
float metres_a_unit(const A& a, const B& b) {
  if constexpr (std::is_same_v<A, HullShape<float>>) {
    return static_cast<float>(1 / a.scale);
  } else {
    return static_cast<float>(1 / b.scale);
  }
}

template <class Real, class A, class B>
SeparationAs<Real> separation_with_hull(const A& a, const B& b, const PairPose<Real>& pose) {
  if constexpr (std::is_same_v<Real, float>) {
    const FloatTest test =
        nearest_separation(float_core(a, pose.a, Vector3f::Zero()), float_core(b, pose.b, pose.d),
                           pose.d, metres_a_unit(a, b));
    if constexpr (kIsSolid<A> && kIsSolid<B>) {
      if (test.is_deep) return shape_depth(a, b, pose, kHullSteps);
    }
    return test.separation;
  } else {
    return core_separation(a, b, pose, CoreTest());
  }
}

}  // namespace carom::scalar
