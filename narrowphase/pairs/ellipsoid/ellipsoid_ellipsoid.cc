// Ellipsoid against ellipsoid.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/ellipsoid/ellipsoid_ellipsoid.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/features/ellipsoids-inl.h"
#include "narrowphase/features/round_tolerances.h"
#include "narrowphase/pairs/round/round_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// Whether a point lies in the ellipsoid by more than rounding.
HWY_INLINE Mask is_surely_within(const F3& semi_axes, const F3& p) {
  const F3 share = {hn::Div(p.x, semi_axes.x), hn::Div(p.y, semi_axes.y),
                    hn::Div(p.z, semi_axes.z)};
  const F least = min(min(semi_axes.x, semi_axes.y), semi_axes.z);
  return hn::And(hn::Ge(least, splat(kThinEllipsoid)),
                 hn::Lt(dot(share, share), splat(1 - kSureShare)));
}

struct EllipsoidEllipsoid : RoundKernel {
  using A = EllipsoidLanes;
  using B = EllipsoidLanes;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const EllipsoidLanes& a,
                              const EllipsoidLanes& b, Report& report) {
    const Rotation turn_a = rotation_of(pose.a), turn_b = rotation_of(pose.b);
    const EllipsoidPairLanes pair(a.semi_axes,
                                  {rotate_back(turn_a, turn_b.x * b.semi_axes.x),
                                   rotate_back(turn_a, turn_b.y * b.semi_axes.y),
                                   rotate_back(turn_a, turn_b.z * b.semi_axes.z)},
                                  rotate_back(turn_a, pose.d));
    const EllipsoidContactLanes contact = pair.find();
    const F separation = hn::Sub(contact.separation, hn::Add(a.rounding, b.rounding));
    const F3 normal = rotate(turn_a, contact.normal), on_core = rotate(turn_a, contact.on_a);
    const F3 on_a = on_core + normal * a.rounding;
    const Mask has_widths = hn::And(has_width(a.semi_axes), has_width(b.semi_axes));
    const Mask is_sure =
        hn::And(hn::And(contact.is_sure, has_widths), hn::Gt(hn::Abs(separation), splat(kSureGap)));
    report(hn::Le(separation, splat(0)), hn::Not(is_sure), no_lanes(), separation, normal, on_a,
           (on_a + normal * separation) - pose.d);
    if (HWY_LIKELY(!report.marks_unsure())) return;
    const F3 common = on_core + normal * hn::Mul(contact.separation, splat(0.5f));
    const Mask is_common =
        hn::And(is_surely_within(a.semi_axes, rotate_back(turn_a, common)),
                is_surely_within(b.semi_axes, rotate_back(turn_b, common - pose.d)));
    report.mark_unproven(hn::Not(hn::Or(is_common, hn::Gt(contact.separation, splat(0)))));
  }
};

void ellipsoid_ellipsoid(const Batch& batch) { run_round_tests<EllipsoidEllipsoid>(batch); }

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(ellipsoid_ellipsoid);

void run_ellipsoid_ellipsoid(const Batch& batch) { CAROM_DISPATCH(ellipsoid_ellipsoid)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
