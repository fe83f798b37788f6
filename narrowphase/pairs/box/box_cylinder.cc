// Box against cylinder.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/box/box_cylinder.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/features/box_cylinder-inl.h"
#include "narrowphase/pairs/round/round_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct BoxCylinder : RoundKernel {
  using A = BoxLanes;
  using B = CylinderLanes;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const BoxLanes& box,
                              const CylinderLanes& cylinder, Report& report) {
    const Rotation turn = rotation_of(pose.a);
    const CylinderAtBoxLanes at_box(
        box.half, rotate_back(turn, pose.d),
        {rotate_back(turn, rotation_of(pose.b).z), cylinder.half_length, cylinder.radius});
    test_box_cylinder(at_box, turn, splat3(0), cylinder.rounding, pose.d, report);
  }
};

void box_cylinder(const Batch& batch) { run_round_kernel<BoxCylinder>(batch); }

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(box_cylinder);

void run_box_cylinder(const Batch& batch) { CAROM_DISPATCH(box_cylinder)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
