// Sphere against cone, in the frame of the cone.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/sphere/sphere_cone.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/features/profile-inl.h"
#include "narrowphase/features/round_tolerances.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// From a point at this distance from the axis, and this height over the middle.
HWY_INLINE ProfileWayLanes way_from_cone(const ConeLanes& cone, F from_axis, F height) {
  const F zero = splat(0), one = splat(1);
  const F rise = hn::Add(cone.half_length, cone.half_length);
  const F squared = hn::Add(hn::Mul(cone.radius, cone.radius), hn::Mul(rise, rise));
  const F to_unit = hn::Div(one, hn::Sqrt(max(squared, splat(kLeastSlant))));
  // The normal of the side; the side leads from the rim along (-out_axial, out_radial).
  const F out_radial = hn::Mul(rise, to_unit), out_axial = hn::Mul(cone.radius, to_unit);
  const F from_rim = hn::Sub(from_axis, cone.radius);
  const F over_base = hn::Add(height, cone.half_length);
  const F over_side = hn::Add(hn::Mul(from_rim, out_radial), hn::Mul(over_base, out_axial));
  const F along = hn::Sub(hn::Mul(over_base, out_radial), hn::Mul(from_rim, out_axial));
  const F beyond_end = hn::Sub(along, clamp(along, zero, hn::Mul(squared, to_unit)));

  const Mask is_below = hn::Lt(over_base, zero);
  const Mask is_inside = hn::AndNot(is_below, hn::Le(over_side, zero));
  const Mask by_base = hn::Or(hn::And(is_below, hn::Le(from_rim, zero)),
                              hn::And(is_inside, hn::Lt(over_base, hn::Neg(over_side))));
  const F radial = hn::Sub(hn::Mul(out_radial, over_side), hn::Mul(out_axial, beyond_end));
  const F axial = hn::Add(hn::Mul(out_axial, over_side), hn::Mul(out_radial, beyond_end));
  const F distance =
      hn::Sqrt(hn::Add(hn::Mul(over_side, over_side), hn::Mul(beyond_end, beyond_end)));
  const F from_side = hn::Div(one, distance);
  const F gap = hn::IfThenElse(is_inside, over_side, distance);
  return {hn::IfThenElse(by_base, hn::Neg(over_base), gap),
          hn::IfThenZeroElse(by_base,
                             hn::IfThenElse(is_inside, out_radial, hn::Mul(radial, from_side))),
          hn::IfThenElse(by_base, splat(-1),
                         hn::IfThenElse(is_inside, out_axial, hn::Mul(axial, from_side)))};
}

struct SphereCone {
  using A = SphereLanes;
  using B = ConeLanes;
  static constexpr Units kUnits = Units::scaled;
  static constexpr Unsure kUnsure = Unsure::everything;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const SphereLanes& sphere,
                              const ConeLanes& cone, Report& report) {
    const Rotation turn = rotation_of(pose.b);
    const F3 centre = rotate_back(turn, -pose.d);
    WayOutLanes way = way_out_of_profile(centre, [&](F from_axis, F height) HWY_ATTR {
      return way_from_cone(cone, from_axis, height);
    });
    way.is_vague =
        hn::Or(way.is_vague, hn::Le(max(cone.radius, cone.half_length), splat(kSmallProfile)));
    report_ball(centre, sphere.radius, cone.rounding, turn, way, report);
  }
};

void sphere_cone(const Batch& batch) { run_batch<SphereCone>(batch); }

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(sphere_cone);

void run_sphere_cone(const Batch& batch) { CAROM_DISPATCH(sphere_cone)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
