// Hull against cylinder.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/hull/hull_cylinder.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/pairs/round/round_kernel-inl.h"
#include "narrowphase/pairs/round/solid_cylinder-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct HullCylinder : RoundKernel {
  using A = HullLanes;
  using B = CylinderLanes;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const HullLanes& hull,
                              const CylinderLanes& cylinder, Report& report) {
    const Rotation turn = rotation_of(pose.a);
    const HullsOfLanes shapes(hull);
    SolidCylinders<HullsOfLanes> pairs(shapes, cylinder, pose.b, turn, pose.d);
    const SolidContactLanes contact = pairs.find(report.valid);
    report_solid(contact, turn, splat3(0), cylinder.rounding, pose.d, report);
    if (HWY_UNLIKELY(report.marks_unsure())) report.mark_unproven(pairs.unproven());
  }
};

void hull_cylinder(const Batch& batch) { run_round_kernel<HullCylinder>(batch); }

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(hull_cylinder);

void run_hull_cylinder(const Batch& batch) { CAROM_DISPATCH(hull_cylinder)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
