// Half-space against ellipsoid: the point of the surface that faces the plane.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/halfspace/halfspace_ellipsoid.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/pairs/halfspace/round_over_plane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

template <class V>
HWY_INLINE LowestPointOf<V> lowest_point(const EllipsoidOf<V>& ellipsoid, const Lanes3<V>& n,
                                         V flat) {
  const Lanes3<V>& axes = ellipsoid.semi_axes;
  const Lanes3<V> reach = {hn::Mul(axes.x, n.x), hn::Mul(axes.y, n.y), hn::Mul(axes.z, n.z)};
  const V height = hn::Sqrt(dot(reach, reach));
  const V share =
      hn::IfThenZeroElse(hn::Le(hn::Add(height, height), flat), hn::Div(splat_as<V>(-1), height));
  const Lanes3<V> out = reach * share;
  return {hn::Neg(height),
          {hn::Mul(axes.x, out.x), hn::Mul(axes.y, out.y), hn::Mul(axes.z, out.z)}};
}

namespace {

void halfspace_ellipsoid(const Batch& batch) {
  run_round_kernel<HalfspaceRound<EllipsoidLanes>>(batch);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(halfspace_ellipsoid);

void run_halfspace_ellipsoid(const Batch& batch) { CAROM_DISPATCH(halfspace_ellipsoid)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
