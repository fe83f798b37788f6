// Half-space against cylinder: the lowest point of a rim, or the middle of the line or disc that
// lies flat.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/halfspace/halfspace_cylinder.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/pairs/halfspace/round_over_plane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

template <class V>
HWY_INLINE LowestPointOf<V> lowest_point(const RimOf<V, ShapeKind::cylinder>& cylinder,
                                         const Lanes3<V>& n, V flat) {
  const V slope = hn::Sqrt(hn::Add(hn::Mul(n.x, n.x), hn::Mul(n.y, n.y)));
  const V of_disc = hn::Mul(cylinder.radius, slope);
  const V of_axis = hn::Mul(cylinder.half_length, hn::Abs(n.z));
  const V out = hn::IfThenZeroElse(hn::Le(hn::Add(of_disc, of_disc), flat),
                                   hn::Div(hn::Neg(cylinder.radius), slope));
  const V end = hn::IfThenZeroElse(hn::Le(hn::Add(of_axis, of_axis), flat),
                                   hn::Neg(hn::CopySign(cylinder.half_length, n.z)));
  return {hn::Neg(hn::Add(of_disc, of_axis)), {hn::Mul(n.x, out), hn::Mul(n.y, out), end}};
}

namespace {

void halfspace_cylinder(const Batch& batch) {
  run_round_kernel<HalfspaceRound<CylinderLanes>>(batch);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(halfspace_cylinder);

void run_halfspace_cylinder(const Batch& batch) { CAROM_DISPATCH(halfspace_cylinder)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
