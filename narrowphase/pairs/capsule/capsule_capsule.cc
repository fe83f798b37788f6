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
  static constexpr Unsure kUnsure = Unsure::in_lanes;

  template <class V, class Report>
  static HWY_INLINE void test(const PoseOf<V>& pose, const CapsuleOf<V>& a, const CapsuleOf<V>& b,
                              Report& report) {
    const RotationOf<V> turn_a = rotation_of(pose.a);
    const RotationOf<V> turn_b = rotation_of(pose.b);
    const Lanes3<V> p = rotate(turn_a, a.a);
    const Lanes3<V> q = rotate(turn_b, b.a) + pose.d;
    const Lanes3<V> d = rotate(turn_a, a.b - a.a);
    const Lanes3<V> e = rotate(turn_b, b.b - b.a);
    const Lanes3<V> r = q - p;
    const V dd = dot(d, d), ee = dot(e, e);
    V s, t;
    Lanes3<V> delta;
    nearest_of_segments(r, d, dd, e, ee, s, t, delta);

    Lanes3<V> way;
    const MaskOf<V> is_across = way_between(d, dd, e, ee, s, t, delta, way);
    const V height = dot(delta, way);
    way = negate_if(hn::And(is_across, hn::Lt(height, splat_as<V>(0))), way);
    const V length = hn::Sqrt(dot(way, way));
    const V to_unit = hn::Div(splat_as<V>(1), length);
    const V distance = hn::IfThenElse(is_across, hn::Mul(hn::Abs(height), to_unit), length);
    // If the cores intersect, the capsules may separate in any direction across both: double
    // precision decides.
    const MaskOf<V> coincide = hn::AndNot(is_across, hn::Le(distance, splat_as<V>(kCoincident)));
    const Lanes3<V> normal = way * to_unit;
    report_grown(p + d * s, q + e * t, normal, distance, a.radius, b.radius, pose,
                 hn::Or(coincide, is_tilted(normal, r, d, e, distance)), no_lanes_of<V>(), report);
  }

 private:
  // Whether the gap between the projections on the normal is less than the distance.
  template <class V>
  static HWY_INLINE MaskOf<V> is_tilted(const Lanes3<V>& n, const Lanes3<V>& r, const Lanes3<V>& d,
                                        const Lanes3<V>& e, V distance) {
    const V zero = splat_as<V>(0);
    const V gap = hn::Sub(hn::Add(dot(n, r), min(dot(n, e), zero)), max(dot(n, d), zero));
    return hn::Lt(gap, hn::Sub(distance, splat_as<V>(CoreTolerance<hn::TFromV<V>>::kTilt)));
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
