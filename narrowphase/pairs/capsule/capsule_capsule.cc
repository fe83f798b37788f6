// Capsule against capsule: the nearest points of their segments (Ericson 2005, 5.1.9).
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/capsule/capsule_capsule.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/features/rounded-inl.h"
#include "narrowphase/features/segment-inl.h"
#include "narrowphase/manifolds/manifold-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct CapsuleCapsule {
  using A = CapsuleLanes;
  using B = CapsuleLanes;
  static constexpr Units kUnits = Units::scaled;
  static constexpr Unsure kUnsure = Unsure::everything;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const A& a, const B& b, Report& report) {
    const Rotation turn_a = rotation_of(pose.a);
    const Rotation turn_b = rotation_of(pose.b);
    const F3 p = rotate(turn_a, a.a);
    const F3 q = rotate(turn_b, b.a) + pose.d;
    const F3 d = rotate(turn_a, a.b - a.a);
    const F3 e = rotate(turn_b, b.b - b.a);
    const F3 r = q - p;
    const F dd = dot(d, d), ee = dot(e, e);
    F s, t;
    F3 delta;
    nearest_of_segments(r, d, dd, e, ee, s, t, delta);

    F3 way;
    const Mask is_across = way_between(d, dd, e, ee, s, t, delta, way);
    const F height = dot(delta, way);
    way = negate_if(hn::And(is_across, hn::Lt(height, splat(0))), way);
    const F length = hn::Sqrt(dot(way, way));
    const F to_unit = hn::Div(splat(1), length);
    const F distance = hn::IfThenElse(is_across, hn::Mul(hn::Abs(height), to_unit), length);
    // If the cores intersect, the capsules may separate in any direction across both: double
    // precision decides.
    const Mask coincide = hn::AndNot(is_across, hn::Le(distance, splat(kCoincident)));
    const F3 normal = way * to_unit;
    report_grown(p + d * s, q + e * t, normal, distance, a.radius, b.radius, pose,
                 hn::Or(coincide, is_tilted(normal, r, d, e, distance)), no_lanes(), report);
  }

 private:
  // Whether the gap between the projections on the normal is less than the distance.
  static HWY_INLINE Mask is_tilted(const F3& n, const F3& r, const F3& d, const F3& e, F distance) {
    const F zero = splat(0);
    const F gap = hn::Sub(hn::Add(dot(n, r), min(dot(n, e), zero)), max(dot(n, d), zero));
    return hn::Lt(gap, hn::Sub(distance, splat(CoreTolerance<float>::kTilt)));
  }
};

void capsule_capsule(const Batch& batch) {
  if (batch.pass == Pass::manifold) return run_manifold<CapsuleLanes, CapsuleLanes>(batch);
  run_batch<CapsuleCapsule>(batch);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(capsule_capsule);

void run_capsule_capsule(const Batch& batch) { CAROM_DISPATCH(capsule_capsule)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
