// Round shapes against any convex shape, as cores in double precision. Float32 leaves all pairs
// without a kernel to it.
//
// Sources: see narrowphase/doubles/gjk.h and penetration_search.h.
#pragma once

#include "narrowphase/doubles/ruled_core.h"
#include "narrowphase/features/halfspace_scalar.h"

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

// The lowest point of the round shape. Of a disc or a side that lies flat, its middle. The plane is
// as far from the core as without a rounding.
template <RoundShape B>
SeparationAs<double> separation(const HalfspaceShape<double>& halfspace, const B& b,
                                const PairPose<double>& pose) {
  const Vector3d d = -pose.d;
  const Plane<double> plane = plane_of(halfspace, pose.a, d);
  Core core;
  make_core(b, pose.b, Vector3d::Zero(), core);
  const CoreVector down = core_vector(-plane.normal);
  const double least = dot(plane.normal, eigen_vector(core.furthest_round(down)));
  const Meeting::Points lowest = furthest_round_points(core, down, kLyingFlat * b.size());
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& p : lowest) sum += p;
  SeparationAs<double> result = flipped(over_plane<double>(
      plane, least - plane.height, sum * (1.0 / static_cast<double>(lowest.size())), b.size(), d));
  result.separation -= core.radius;
  result.arm_b -= result.normal * core.radius;
  return result;
}

template <class A, class B>
requires(RoundShape<A> || RoundShape<B>) Separation
    separation(const A&, const B&, const PairPose<float>&) {
  return not_in_float<float>();
}

}  // namespace carom::scalar
