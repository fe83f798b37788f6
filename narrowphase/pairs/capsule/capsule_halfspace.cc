// Capsule against half-space: the lower end of the segment, or the middle of one that lies flat.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/capsule/capsule_halfspace.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/features/halfspace-inl.h"
#include "narrowphase/manifolds/manifold-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct CapsuleHalfspace {
  using A = CapsuleLanes;
  using B = HalfspaceLanes;
  static constexpr Units kUnits = Units::scaled;
  static constexpr Unsure kUnsure = Unsure::in_lanes;

  template <class V, class Report>
  static HWY_INLINE void test(const PoseOf<V>& pose, const CapsuleOf<V>& capsule,
                              const HalfspaceOf<V>& halfspace, Report& report) {
    Lanes3<V> normal;
    V height, plane_size;
    place_plane(halfspace, pose.b, pose.d, normal, height, plane_size);
    const RotationOf<V> turn = rotation_of(pose.a);
    const Lanes3<V> a = rotate(turn, capsule.a);
    const Lanes3<V> b = rotate(turn, capsule.b);
    const V height_a = dot(normal, a);
    const V height_b = dot(normal, b);
    const V separation = hn::Sub(hn::Sub(min(height_a, height_b), height), capsule.radius);

    const V size = capsule.extent();
    const MaskOf<V> lies_flat =
        hn::Le(hn::Abs(hn::Sub(height_a, height_b)), hn::Mul(splat_as<V>(kLyingFlat), size));
    const Lanes3<V> end = select(hn::Lt(height_a, height_b), a, b);
    const Lanes3<V> core = select(lies_flat, (a + b) * splat_as<V>(0.5f), end);
    report_over_plane(normal, plane_size, separation, core - normal * capsule.radius, size, pose.d,
                      report);
  }
};

void capsule_halfspace(const Batch& batch) {
  if (batch.pass == Pass::manifold) return run_manifold<CapsuleLanes, HalfspaceLanes>(batch);
  run_batch<CapsuleHalfspace>(batch);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(capsule_halfspace);

void run_capsule_halfspace(const Batch& batch) { CAROM_DISPATCH(capsule_halfspace)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
