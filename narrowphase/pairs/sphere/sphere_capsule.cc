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
  static constexpr Unsure kUnsure = Unsure::everything;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const A& sphere, const B& capsule,
                              Report& report) {
    const Rotation turn = rotation_of(pose.b);
    const F3 a = rotate(turn, capsule.a) + pose.d;
    const F3 b = rotate(turn, capsule.b) + pose.d;
    const F3 centre = splat3(0);
    F3 nearest, delta;
    Mask is_across;
    nearest_on_segment(centre, a, b, nearest, delta, is_across);
    const F distance = hn::Sqrt(dot(delta, delta));

    // A centre on the segment may leave in any direction perpendicular to it: double precision
    // decides.
    const F least = hn::IfThenElse(is_across, splat(kNearSegment<float>), splat(kCoincident));
    const Mask coincide = hn::Le(distance, least);
    report_grown(centre, nearest, delta * hn::Div(splat(1), distance), distance, sphere.radius,
                 capsule.radius, pose, coincide, no_lanes(), report);
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
