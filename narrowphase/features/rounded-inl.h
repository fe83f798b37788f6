// Shapes made of a core (point, segment, triangle, box) grown by a radius, in lanes.
#if defined(CAROM_NARROWPHASE_FEATURES_ROUNDED_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_FEATURES_ROUNDED_INL_H_
#undef CAROM_NARROWPHASE_FEATURES_ROUNDED_INL_H_
#else
#define CAROM_NARROWPHASE_FEATURES_ROUNDED_INL_H_
#endif

#include "base/tolerances.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Whether rounding in float32 may have changed the sign of a separation in scaled units.
HWY_INLINE Mask is_near_touch(F separation) {
  return hn::Le(hn::Abs(separation), splat(kNearTouchScaled));
}
HWY_INLINE DoubleMask is_near_touch(D) { return no_lanes_of<D>(); }

// Reports two grown cores. `core_a` and `core_b` are the nearest points of the cores, relative to
// A, and `distance` apart. `unsure` and `degenerate` add to what follows from the separation.
template <class V, class Report>
HWY_INLINE void report_grown(const Lanes3<V>& core_a, const Lanes3<V>& core_b,
                             const Lanes3<V>& normal, V distance, V radius_a, V radius_b,
                             const PoseOf<V>& pose, MaskOf<V> unsure, MaskOf<V> degenerate,
                             Report& report) {
  const V separation = hn::Sub(hn::Sub(distance, max(radius_a, radius_b)), min(radius_a, radius_b));
  report(hn::Le(separation, splat_as<V>(0)), hn::Or(unsure, is_near_touch(separation)), degenerate,
         separation, normal, core_a + normal * radius_a, (core_b - pose.d) - normal * radius_b);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_FEATURES_ROUNDED_INL_H_
