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
  static constexpr Unsure kUnsure = Unsure::everything;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const A& capsule, const B& box,
                              Report& report) {
    const Rotation turn = rotation_of(pose.a);
    const F3 centre = ((pose.d + box.lower) + (pose.d + box.upper)) * splat(0.5f);
    const F3 half = (box.upper - box.lower) * splat(0.5f);
    const F3 start = rotate(turn, capsule.a) - centre;
    BoxContact contact;
    segment_box(start, rotate(turn, capsule.b - capsule.a), half, contact);

    report_grown(contact.on_other + centre, contact.on_box + centre, -contact.normal,
                 contact.separation, capsule.radius, splat(0), pose, contact.unsure, no_lanes(),
                 report);
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
