// Sphere against capsule: the centre against the capsule's segment (Ericson 2005, 4.5.1).
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/sphere/sphere_capsule.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/features/rounded-inl.h"
#include "narrowphase/features/segment-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct SphereCapsule {
  using A = SphereLanes;
  using B = CapsuleLanes;
  static constexpr Units kUnits = Units::scaled;
  static constexpr Unsure kUnsure = Unsure::in_lanes;
  static constexpr bool kTestFetches = true;

  template <class V, class Report>
  static HWY_INLINE void test(const PoseOf<V>& pose, const SphereOf<V>& sphere,
                              const CapsuleOf<V>& capsule, Report& report) {
    report.template fetch<0>();
    const RotationOf<V> turn = rotation_of(pose.b);
    const Lanes3<V> a = rotate(turn, capsule.a) + pose.d;
    const Lanes3<V> b = rotate(turn, capsule.b) + pose.d;
    const Lanes3<V> centre = {splat_as<V>(0), splat_as<V>(0), splat_as<V>(0)};
    report.template fetch<1>();
    Lanes3<V> nearest, delta;
    MaskOf<V> is_across;
    nearest_on_segment(centre, a, b, nearest, delta, is_across);
    report.template fetch<2>();
    const V distance = hn::Sqrt(dot(delta, delta));

    // A centre on the segment may leave in any direction perpendicular to it: double precision
    // decides.
    const V least = hn::IfThenElse(is_across, splat_as<V>(kNearSegment<hn::TFromV<V>>),
                                   splat_as<V>(kCoincident));
    const MaskOf<V> coincide = hn::Le(distance, least);
    report.template fetch<3>();
    report_grown(centre, nearest, delta * hn::Div(splat_as<V>(1), distance), distance,
                 sphere.radius, capsule.radius, pose, coincide, no_lanes_of<V>(), report);
  }
};

void sphere_capsule(const Batch& batch) { run_batch<SphereCapsule>(batch); }

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(sphere_capsule);

void run_sphere_capsule(const Batch& batch) { CAROM_DISPATCH(sphere_capsule)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
