// Capsule against box: the capsule's segment, in the frame of the box.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/capsule/capsule_box.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/features/rounded-inl.h"
#include "narrowphase/features/segment_box-inl.h"
#include "narrowphase/manifolds/manifold-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct CapsuleBox {
  using A = CapsuleLanes;
  using B = BoxLanes;
  static constexpr Units kUnits = Units::scaled;
  static constexpr Unsure kUnsure = Unsure::in_lanes;

  template <class V, class Report>
  static HWY_INLINE void test(const PoseOf<V>& pose, const CapsuleOf<V>& capsule,
                              const BoxOf<V>& box, Report& report) {
    const RotationOf<V> turn = rotation_of(relative_rotation(pose.b, pose.a));
    const RotationOf<V> turn_box = rotation_of(pose.b);
    const Lanes3<V> start = rotate(turn, capsule.a) + rotate_back(turn_box, -pose.d);
    BoxContactOf<V> contact;
    segment_box(start, rotate(turn, capsule.b - capsule.a), box.half, contact);

    const Lanes3<V> core_a = rotate(turn_box, contact.on_other) + pose.d;
    const Lanes3<V> core_b = rotate(turn_box, contact.on_box) + pose.d;
    report_grown(core_a, core_b, -rotate(turn_box, contact.normal), contact.separation,
                 capsule.radius, splat_as<V>(0), pose, contact.unsure, no_lanes_of<V>(), report);
  }
};

void capsule_box(const Batch& batch) {
  if (batch.pass == Pass::manifold) return run_manifold<CapsuleLanes, BoxLanes>(batch);
  run_batch<CapsuleBox>(batch);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(capsule_box);

void run_capsule_box(const Batch& batch) { CAROM_DISPATCH(capsule_box)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
