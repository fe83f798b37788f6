// Capsule against cylinder.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/capsule/capsule_cylinder.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/features/cylinders-inl.h"
#include "narrowphase/features/round_tolerances.h"
#include "narrowphase/pairs/round/round_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct CapsuleCylinder : RoundKernel {
  using A = CapsuleLanes;
  using B = CylinderLanes;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const CapsuleLanes& capsule,
                              const CylinderLanes& cylinder, Report& report) {
    const F half = splat(0.5f);
    const Rotation turn = rotation_of(pose.a);
    const F3 way = rotate(turn, capsule.b - capsule.a) * half;
    const F3 middle = rotate(turn, capsule.a + capsule.b) * half;
    const F length = hn::Sqrt(dot(way, way));
    const AxialCoreLanes core_a = {way * hn::Div(splat(1), max(length, splat(kLeastRim))), length,
                                   splat(0)};
    const AxialCoreLanes core_b = {rotation_of(pose.b).z, cylinder.half_length, cylinder.radius};
    const CylinderContactLanes contact = cylinder_contact(core_a, core_b, pose.d - middle);
    const F3 n = contact.normal;
    const F separation = hn::Sub(contact.separation, hn::Add(capsule.radius, cylinder.rounding));
    const Mask is_sure = hn::And(hn::And(contact.is_sure, hn::Ge(length, splat(kShortAxis))),
                                 hn::Gt(hn::Abs(separation), splat(kSureGap)));
    const F3 on_a = (middle + contact.on_a) + n * capsule.radius;
    report(hn::Le(separation, splat(0)), hn::Not(is_sure), no_lanes(), separation, n, on_a,
           (on_a + n * separation) - pose.d);
    if (HWY_UNLIKELY(report.marks_unsure())) report.mark_unproven(hn::Not(contact.is_proven));
  }
};

void capsule_cylinder(const Batch& batch) { run_round_tests<CapsuleCylinder>(batch); }

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(capsule_cylinder);

void run_capsule_cylinder(const Batch& batch) { CAROM_DISPATCH(capsule_cylinder)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
