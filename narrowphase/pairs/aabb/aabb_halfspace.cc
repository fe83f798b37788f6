// Axis-aligned box against half-space: the lowest corner, or the middle of the edge or face that
// lies flat.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/aabb/aabb_halfspace.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/features/halfspace-inl.h"
#include "narrowphase/manifolds/manifold-inl.h"
#include "simd/axis-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct AabbHalfspace {
  using A = AabbLanes;
  using B = HalfspaceLanes;
  static constexpr Units kUnits = Units::scaled;
  static constexpr Unsure kUnsure = Unsure::in_lanes;

  template <class V, class Report>
  static HWY_INLINE void test(const PoseOf<V>& pose, const AabbOf<V>& box,
                              const HalfspaceOf<V>& halfspace, Report& report) {
    Lanes3<V> normal;
    V height, plane_size;
    place_plane(halfspace, pose.b, pose.d, normal, height, plane_size);
    const Lanes3<V> corner = {
        hn::IfThenElse(hn::Gt(normal.x, splat_as<V>(0)), box.lower.x, box.upper.x),
        hn::IfThenElse(hn::Gt(normal.y, splat_as<V>(0)), box.lower.y, box.upper.y),
        hn::IfThenElse(hn::Gt(normal.z, splat_as<V>(0)), box.lower.z, box.upper.z)};
    const V separation = hn::Sub(dot(normal, corner), height);

    const V size = box.extent();
    const V flat = hn::Mul(splat_as<V>(kLyingFlat), size);
    const Lanes3<V> half = (box.upper - box.lower) * splat_as<V>(0.5f);
    const Mask3Of<V> lies_flat = {hn::Le(hn::Mul(hn::Abs(normal.x), half.x), flat),
                                  hn::Le(hn::Mul(hn::Abs(normal.y), half.y), flat),
                                  hn::Le(hn::Mul(hn::Abs(normal.z), half.z), flat)};
    const Lanes3<V> lowest = select(lies_flat, (box.lower + box.upper) * splat_as<V>(0.5f), corner);
    report_over_plane(normal, plane_size, separation, lowest, size, pose.d, report);
  }
};

void aabb_halfspace(const Batch& batch) {
  if (batch.pass == Pass::manifold) return run_manifold<AabbLanes, HalfspaceLanes>(batch);
  run_batch<AabbHalfspace>(batch);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(aabb_halfspace);

void run_aabb_halfspace(const Batch& batch) { CAROM_DISPATCH(aabb_halfspace)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
