// Axis-aligned box against axis-aligned box: gaps axis by axis (Ericson 2005, 4.2).
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/aabb/aabb_aabb.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/manifolds/manifold-inl.h"
#include "simd/axis-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct AabbAabb {
  using A = AabbLanes;
  using B = AabbLanes;
  // Differences of given coordinates: exact for boxes in world coordinates.
  static constexpr Units kUnits = Units::metres;
  static constexpr Unsure kUnsure = Unsure::nothing;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const A& a, const B& b, Report& report) {
    const F3 gap_if_above = (b.lower - a.upper) + pose.d;
    const F3 gap_if_below = (a.lower - b.upper) - pose.d;
    const Mask3 above = {hn::Ge(gap_if_above.x, gap_if_below.x),
                         hn::Ge(gap_if_above.y, gap_if_below.y),
                         hn::Ge(gap_if_above.z, gap_if_below.z)};
    const F3 gap = select(above, gap_if_above, gap_if_below);
    const Mask overlapping =
        hn::And(hn::And(hn::Le(gap.x, splat(0)), hn::Le(gap.y, splat(0))), hn::Le(gap.z, splat(0)));
    const F3 open = min(max(gap, splat3(0)), splat3(FLT_MAX));
    const Length apart = measure(open);

    // Overlapping: least depth, along the axis of the greatest (negative) gap.
    const AxisMasks axis = greatest_axis(gap);
    const Mask3 below = {hn::Not(above.x), hn::Not(above.y), hn::Not(above.z)};
    const F3 away = select(above, apart.direction, -apart.direction);

    const Mask3 at_face = {faces(gap.x, axis.x, overlapping), faces(gap.y, axis.y, overlapping),
                           faces(gap.z, axis.z, overlapping)};
    // On axes where the boxes overlap, the middle of the overlap, in the frame of A.
    const F3 middle =
        max(a.lower, b.lower + pose.d) * splat(0.5f) + min(a.upper, b.upper + pose.d) * splat(0.5f);
    Mask unsure = no_lanes();
    if (HWY_UNLIKELY(report.marks_unsure())) unsure = is_near_touch(pose.d, a, b, gap);
    report(overlapping, unsure, no_lanes(),
           hn::IfThenElse(overlapping, pick(axis, gap), apart.length),
           select(overlapping, signed_axis(axis, below), away),
           select(at_face, select(above, a.upper, a.lower), middle),
           select(at_face, select(above, b.lower, b.upper), middle - pose.d));
  }

 private:
  // Whether the decision is within rounding: three roundings of numbers of this size.
  static HWY_INLINE Mask is_near_touch(const F3& d, const A& a, const B& b, const F3& gap) {
    const F size = hn::Add(largest_component(d), max(a.extent(), b.extent()));
    const F greatest = max(max(gap.x, gap.y), gap.z);
    return hn::Le(hn::Abs(greatest), hn::Mul(size, splat(kNearTouch)));
  }

  // Whether the witness points lie on the two facing faces of this axis.
  static HWY_INLINE Mask faces(F gap, Mask is_axis, Mask overlapping) {
    return hn::Or(hn::Gt(gap, splat(0)), hn::And(overlapping, is_axis));
  }
};

void aabb_aabb(const Batch& batch) {
  if (batch.pass == Pass::manifold) return run_manifold<AabbLanes, AabbLanes>(batch);
  run_batch<AabbAabb>(batch);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(aabb_aabb);

void run_aabb_aabb(const Batch& batch) { CAROM_DISPATCH(aabb_aabb)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
