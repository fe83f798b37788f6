// Sphere against sphere: the distance of the centres less both radii (Ericson 2005, 4.3.1).
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/sphere/sphere_sphere.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/features/ball-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct SphereSphere {
  using A = SphereLanes;
  using B = SphereLanes;
  static constexpr Units kUnits = Units::metres;
  static constexpr Unsure kUnsure = Unsure::separation;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const A& a, const B& b, Report& report) {
    const Length distance = measure(pose.d);
    // The larger radius first: that difference is exact near touch (Sterbenz), and so is the next.
    const F separation =
        hn::Sub(hn::Sub(distance.length, max(a.radius, b.radius)), min(a.radius, b.radius));
    // Coincident centres separate equally well in every direction: +x, by convention.
    const F3 normal =
        select(distance.is_zero, F3{splat(1), splat(0), splat(0)}, distance.direction);
    const Mask near_touch =
        hn::Le(hn::Abs(separation), hn::Mul(distance.length, splat(kNearTouch)));
    report(hn::Le(separation, splat(0)), near_touch, distance.is_zero, separation, normal,
           normal * a.radius, -(normal * b.radius));
  }

  static HWY_INLINE D exact_separation(const D3& d, const SphereOf<D>& a, const SphereOf<D>& b,
                                       DoubleMask& is_proven) {
    const D squared_distance = dot(d, d);
    const D reach = hn::Add(a.radius, b.radius);
    is_proven = is_proven_gap(squared_distance, reach);
    return gap_to_ball(squared_distance, reach);
  }
};

void sphere_sphere(const Batch& batch) { run_batch<SphereSphere>(batch); }

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(sphere_sphere);

void run_sphere_sphere(const Batch& batch) { CAROM_DISPATCH(sphere_sphere)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
