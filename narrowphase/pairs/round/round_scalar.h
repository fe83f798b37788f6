// Round shapes against any convex shape, as cores in double precision. Float32 leaves all pairs
// without a kernel to it.
//
// Sources: see narrowphase/doubles/gjk.h and penetration_search.h.
#pragma once

#include "narrowphase/doubles/ruled_core.h"
#include "narrowphase/pairs/halfspace/round_over_plane_scalar.h"

namespace carom::scalar {

template <class S>
inline constexpr bool kIsHalfspace = false;
template <class Real>
inline constexpr bool kIsHalfspace<HalfspaceShape<Real>> = true;

template <class S>
concept HasCore = requires(S shape, Quaternion<double> q, Core core) {
  make_core(shape, q, Vector3d(), core);
};

template <class A, class B>
requires((RoundShape<A> || RoundShape<B>)&&!kIsHalfspace<A>)
    SeparationAs<double> separation(const A& a, const B& b, const PairPose<double>& pose)
requires(HasCore<A>&& HasCore<B>) {
  if constexpr (std::is_same_v<B, TriangleShape<double>>) {
    if (b.is_special()) return ruled_round(a, b, pose, CoreTest{});
  }
  return core_separation(a, b, pose, CoreTest{});
}

// The lowest point of any round shape, by its core, as lowest_point() gives it.
template <RoundShape S>
LowestPoint<double> lowest_point_of_core(const S& shape, const Vector3d& n, double flat) {
  Core core;
  make_core(shape, {Vector3d::Zero(), 1}, Vector3d::Zero(), core);
  const CoreVector down = core_vector(-n);
  const Meeting::Points lowest = furthest_round_points(core, down, flat);
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& p : lowest) sum += p;
  return {dot(n, eigen_vector(core.furthest_round(down))),
          sum * (1.0 / static_cast<double>(lowest.size()))};
}

// Shapes without a kernel over half-spaces.
template <RoundShape B>
requires(!HasLowestPoint<B, double>) SeparationAs<double> separation(
    const HalfspaceShape<double>& halfspace, const B& b, const PairPose<double>& pose) {
  return round_over_plane(halfspace, b, pose, [&b](const Vector3d& n, double flat) {
    return lowest_point_of_core(b, n, flat);
  });
}

template <class A, class B>
requires((RoundShape<A> ||
          RoundShape<B>)&&!(kIsHalfspace<A> && HasLowestPoint<B, float>)) Separation
    separation(const A&, const B&, const PairPose<float>&) {
  return not_in_float<float>();
}

}  // namespace carom::scalar
