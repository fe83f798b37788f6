// A ball and a body that is round about its z axis, in lanes. Source and reasons:
// narrowphase/features/profile_scalar.h, which gives the same bits.
#if defined(CAROM_NARROWPHASE_FEATURES_PROFILE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_FEATURES_PROFILE_INL_H_
#undef CAROM_NARROWPHASE_FEATURES_PROFILE_INL_H_
#else
#define CAROM_NARROWPHASE_FEATURES_PROFILE_INL_H_
#endif

#include "base/tolerances.h"
#include "narrowphase/features/round_tolerances.h"
#include "narrowphase/features/rounded-inl.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// The gap from a point to a shape, negative inside, and the unit vector `out` of the shape's frame
// along which the point leaves.
struct WayOutLanes {
  F gap;
  F3 out;
  Mask is_vague;  // rounding may have turned `out`
};

// The same in the plane through the axis and the point.
struct ProfileWayLanes {
  F gap, radial, axial;
};

// Calls way_from(distance from the axis, height) with the point's place in that plane.
template <class WayFrom>
HWY_INLINE WayOutLanes way_out_of_profile(const F3& point, const WayFrom& way_from) {
  const F from_axis = hn::Sqrt(hn::Add(hn::Mul(point.x, point.x), hn::Mul(point.y, point.y)));
  const ProfileWayLanes way = way_from(from_axis, point.z);
  const F share = hn::Div(way.radial, max(from_axis, splat(kCoincident)));
  const Mask is_near_axis = hn::Le(from_axis, splat(kNearSegment<float>));
  const Mask is_vague =
      hn::Or(hn::And(is_near_axis, hn::Gt(hn::Abs(way.radial), splat(kAlongAxis))),
             hn::Le(hn::Abs(way.gap), splat(kCoincident)));
  return {way.gap, {hn::Mul(point.x, share), hn::Mul(point.y, share), way.axial}, is_vague};
}

// `centre`: of the ball, in the frame of B, which `turn` turns into the world's. `rounding`: of B.
template <class Report>
HWY_INLINE void report_ball(const F3& centre, F radius, F rounding, const Rotation& turn,
                            const WayOutLanes& way, Report& report) {
  const F separation = hn::Sub(way.gap, hn::Add(radius, rounding));
  const F3 normal = -rotate(turn, way.out);
  report(hn::Le(separation, splat(0)), hn::Or(is_near_touch(separation), way.is_vague), no_lanes(),
         separation, normal, normal * radius,
         rotate(turn, centre - way.out * hn::Sub(way.gap, rounding)));
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_FEATURES_PROFILE_INL_H_
