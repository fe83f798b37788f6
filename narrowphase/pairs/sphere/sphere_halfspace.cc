// Sphere against half-space: the height of the centre over the plane.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/sphere/sphere_halfspace.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/features/halfspace-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct SphereHalfspace {
  using A = SphereLanes;
  using B = HalfspaceLanes;
  static constexpr Units kUnits = Units::scaled;
  static constexpr Unsure kUnsure = Unsure::in_lanes;

  template <class V, class Report>
  static HWY_INLINE void test(const PoseOf<V>& pose, const SphereOf<V>& sphere,
                              const HalfspaceOf<V>& halfspace, Report& report) {
    Lanes3<V> normal;
    V height, plane_size;
    place_plane(halfspace, pose.b, pose.d, normal, height, plane_size);
    const V separation = hn::Sub(hn::Neg(height), sphere.radius);
    report_over_plane(normal, plane_size, separation, normal * hn::Neg(sphere.radius),
                      sphere.radius, pose.d, report);
  }
};

void sphere_halfspace(const Batch& batch) { run_batch<SphereHalfspace>(batch); }

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(sphere_halfspace);

void run_sphere_halfspace(const Batch& batch) { CAROM_DISPATCH(sphere_halfspace)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
