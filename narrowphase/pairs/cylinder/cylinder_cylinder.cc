// Cylinder against cylinder.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/cylinder/cylinder_cylinder.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/features/cylinders-inl.h"
#include "narrowphase/pairs/round/round_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct CylinderCylinder : RoundKernel {
  using A = CylinderLanes;
  using B = CylinderLanes;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const CylinderLanes& a, const CylinderLanes& b,
                              Report& report) {
    const AxialCoreLanes core_a = {rotation_of(pose.a).z, a.half_length, a.radius};
    const AxialCoreLanes core_b = {rotation_of(pose.b).z, b.half_length, b.radius};
    const CylinderContactLanes contact = cylinder_contact(core_a, core_b, pose.d);
    const F3 n = contact.normal;
    const F separation = hn::Sub(contact.separation, hn::Add(a.rounding, b.rounding));
    const F3 on_a = contact.on_a + n * a.rounding;
    const Mask is_sure = hn::And(contact.is_sure, hn::Gt(hn::Abs(separation), splat(kSureGap)));
    report(hn::Le(separation, splat(0)), hn::Not(is_sure), no_lanes(), separation, n, on_a,
           (on_a + n * separation) - pose.d);
    if (HWY_UNLIKELY(report.marks_unsure())) report.mark_unproven(hn::Not(contact.is_proven));
  }
};

void cylinder_cylinder(const Batch& batch) { run_round_kernel<CylinderCylinder>(batch); }

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(cylinder_cylinder);

void run_cylinder_cylinder(const Batch& batch) { CAROM_DISPATCH(cylinder_cylinder)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
