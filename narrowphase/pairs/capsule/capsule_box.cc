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
  static constexpr Unsure kUnsure = Unsure::everything;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const A& capsule, const B& box,
                              Report& report) {
    const Rotation turn = rotation_of(relative_rotation(pose.b, pose.a));
    const Rotation turn_box = rotation_of(pose.b);
    const F3 start = rotate(turn, capsule.a) + rotate_back(turn_box, -pose.d);
    BoxContact contact;
    segment_box(start, rotate(turn, capsule.b - capsule.a), box.half, contact);

    const F3 core_a = rotate(turn_box, contact.on_other) + pose.d;
    const F3 core_b = rotate(turn_box, contact.on_box) + pose.d;
    report_grown(core_a, core_b, -rotate(turn_box, contact.normal), contact.separation,
                 capsule.radius, splat(0), pose, contact.unsure, no_lanes(), report);
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
