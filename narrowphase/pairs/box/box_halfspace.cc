// Box against half-space: the lowest corner, or the middle of the edge or face that lies flat.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/box/box_halfspace.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/features/halfspace-inl.h"
#include "narrowphase/manifolds/manifold-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct BoxHalfspace {
  using A = BoxLanes;
  using B = HalfspaceLanes;
  static constexpr Units kUnits = Units::scaled;
  static constexpr Unsure kUnsure = Unsure::in_lanes;

  template <class V, class Report>
  static HWY_INLINE void test(const PoseOf<V>& pose, const BoxOf<V>& box,
                              const HalfspaceOf<V>& halfspace, Report& report) {
    Lanes3<V> normal;
    V height, plane_size;
    place_plane(halfspace, pose.b, pose.d, normal, height, plane_size);
    const RotationOf<V> turn = rotation_of(pose.a);
    const Lanes3<V> slope = rotate_back(turn, normal);
    const Lanes3<V> drop = {hn::Mul(hn::Abs(slope.x), box.half.x),
                            hn::Mul(hn::Abs(slope.y), box.half.y),
                            hn::Mul(hn::Abs(slope.z), box.half.z)};
    const V separation = hn::Sub(hn::Neg(hn::Add(hn::Add(drop.x, drop.y), drop.z)), height);

    const V size = box.extent();
    const V flat = hn::Mul(splat_as<V>(kLyingFlat), size);
    const Lanes3<V> lowest = rotate(turn, {lower_end(slope.x, drop.x, box.half.x, flat),
                                           lower_end(slope.y, drop.y, box.half.y, flat),
                                           lower_end(slope.z, drop.z, box.half.z, flat)});
    report_over_plane(normal, plane_size, separation, lowest, size, pose.d, report);
  }

 private:
  // The lower end of an axis of the box; its middle if it lies flat.
  template <class V>
  static HWY_INLINE V lower_end(V slope, V drop, V half, V flat) {
    const V end = hn::IfThenElse(hn::Gt(slope, splat_as<V>(0)), hn::Neg(half), half);
    return hn::IfThenElseZero(hn::Gt(drop, flat), end);
  }
};

void box_halfspace(const Batch& batch) {
  if (batch.pass == Pass::manifold) return run_manifold<BoxLanes, HalfspaceLanes>(batch);
  run_batch<BoxHalfspace>(batch);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(box_halfspace);

void run_box_halfspace(const Batch& batch) { CAROM_DISPATCH(box_halfspace)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
