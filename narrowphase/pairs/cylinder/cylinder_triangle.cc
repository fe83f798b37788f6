// Cylinder against triangle, which is seen as the first shape.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/cylinder/cylinder_triangle.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/pairs/round/round_kernel-inl.h"
#include "narrowphase/pairs/round/solid_cylinder-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct CylinderTriangle : RoundKernel {
  using A = CylinderLanes;
  using B = TriangleLanes;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const CylinderLanes& cylinder,
                              const TriangleLanes& triangle, Report& report) {
    const Rotation turn = rotation_of(pose.b);
    const F3 d = -pose.d;
    const TrianglesOfLanes shapes(triangle);
    SolidCylinders<TrianglesOfLanes> pairs(shapes, cylinder, pose.a, turn, d);
    const SolidContactLanes contact = pairs.find(report.valid);
    const auto flipped = [&](Mask overlap, Mask unsure, Mask degenerate, F separation, const F3& n,
                             const F3& on_a, const F3& on_b) HWY_ATTR {
      report(overlap, unsure, degenerate, separation, -n, on_b, on_a);
    };
    report_solid(contact, turn, splat3(0), cylinder.rounding, d, flipped);
    if (HWY_UNLIKELY(report.marks_unsure())) report.mark_unproven(pairs.unproven());
  }
};

void cylinder_triangle(const Batch& batch) { run_round_kernel<CylinderTriangle>(batch); }

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(cylinder_triangle);

void run_cylinder_triangle(const Batch& batch) { CAROM_DISPATCH(cylinder_triangle)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
