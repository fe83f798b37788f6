// Capsule against a box along the world axes: the capsule's segment, seen from the centre of the
// box.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/capsule/capsule_aabb.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/features/rounded-inl.h"
#include "narrowphase/features/segment_box-inl.h"
#include "narrowphase/manifolds/manifold-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct CapsuleAabb {
  using A = CapsuleLanes;
  using B = AabbLanes;
  static constexpr Units kUnits = Units::scaled;
  static constexpr Unsure kUnsure = Unsure::in_lanes;

  template <class V, class Report>
  static HWY_INLINE void test(const PoseOf<V>& pose, const CapsuleOf<V>& capsule,
                              const AabbOf<V>& box, Report& report) {
    const RotationOf<V> turn = rotation_of(pose.a);
    const Lanes3<V> centre = ((pose.d + box.lower) + (pose.d + box.upper)) * splat_as<V>(0.5f);
    const Lanes3<V> half = (box.upper - box.lower) * splat_as<V>(0.5f);
    const Lanes3<V> start = rotate(turn, capsule.a) - centre;
    BoxContactOf<V> contact;
    segment_box(start, rotate(turn, capsule.b - capsule.a), half, contact);

    report_grown(contact.on_other + centre, contact.on_box + centre, -contact.normal,
                 contact.separation, capsule.radius, splat_as<V>(0), pose, contact.unsure,
                 no_lanes_of<V>(), report);
  }
};

void capsule_aabb(const Batch& batch) {
  if (batch.pass == Pass::manifold) return run_manifold<CapsuleLanes, AabbLanes>(batch);
  run_batch<CapsuleAabb>(batch);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(capsule_aabb);

void run_capsule_aabb(const Batch& batch) { CAROM_DISPATCH(capsule_aabb)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
