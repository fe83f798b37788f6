// Half-space against cone: the tip or the lowest point of the rim, or the middle of the line or
// disc that lies flat.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/halfspace/halfspace_cone.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/pairs/halfspace/round_over_plane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

template <class V>
HWY_INLINE LowestPointOf<V> lowest_point(const RimOf<V, ShapeKind::cone>& cone, const Lanes3<V>& n,
                                         V flat) {
  const V slope = hn::Sqrt(hn::Add(hn::Mul(n.x, n.x), hn::Mul(n.y, n.y)));
  const V of_disc = hn::Mul(cone.radius, slope);
  const V of_tip = hn::Mul(cone.half_length, n.z), of_rim = hn::Neg(hn::Add(of_disc, of_tip));
  const V out = hn::IfThenZeroElse(hn::Le(hn::Add(of_disc, of_disc), flat),
                                   hn::Div(hn::Neg(cone.radius), slope));
  const MaskOf<V> is_rim = hn::Lt(of_rim, of_tip);
  const V zero = splat_as<V>(0);
  const Lanes3<V> rim = {hn::Mul(n.x, out), hn::Mul(n.y, out), hn::Neg(cone.half_length)};
  const Lanes3<V> tip = {zero, zero, cone.half_length};
  const MaskOf<V> lies = hn::Le(hn::Abs(hn::Sub(of_rim, of_tip)), flat);
  return {hn::IfThenElse(is_rim, of_rim, of_tip),
          select(lies, (rim + tip) * splat_as<V>(0.5f), select(is_rim, rim, tip))};
}

namespace {

void halfspace_cone(const Batch& batch) { run_round_kernel<HalfspaceRound<ConeLanes>>(batch); }

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(halfspace_cone);

void run_halfspace_cone(const Batch& batch) { CAROM_DISPATCH(halfspace_cone)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
