// Box along the world axes against cylinder.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/aabb/aabb_cylinder.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/features/box_cylinder-inl.h"
#include "narrowphase/pairs/round/round_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct AabbCylinder : RoundKernel {
  using A = AabbLanes;
  using B = CylinderLanes;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const AabbLanes& box,
                              const CylinderLanes& cylinder, Report& report) {
    const F half = splat(0.5f), zero = splat(0), one = splat(1);
    const F3 middle = ((pose.d - box.lower) + (pose.d - box.upper)) * half;
    const CylinderAtBoxLanes at_box((box.upper - box.lower) * half, middle,
                                    {rotation_of(pose.b).z, cylinder.half_length, cylinder.radius});
    const Rotation world = {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}};
    test_box_cylinder(at_box, world, (box.lower + box.upper) * half, cylinder.rounding, pose.d,
                      report);
  }
};

void aabb_cylinder(const Batch& batch) { run_round_kernel<AabbCylinder>(batch); }

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(aabb_cylinder);

void run_aabb_cylinder(const Batch& batch) { CAROM_DISPATCH(aabb_cylinder)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
