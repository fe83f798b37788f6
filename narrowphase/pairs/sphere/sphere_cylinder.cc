// Sphere against cylinder, in the frame of the cylinder.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/sphere/sphere_cylinder.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/features/profile-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// From a point at this distance from the axis, and this height over the middle.
HWY_INLINE ProfileWayLanes way_from_cylinder(const CylinderLanes& cylinder, F from_axis, F height) {
  const F zero = splat(0), one = splat(1);
  const F beyond_side = hn::Sub(from_axis, cylinder.radius);
  const F beyond_cap = hn::Sub(hn::Abs(height), cylinder.half_length);
  const F aside = max(beyond_side, zero), above = max(beyond_cap, zero);
  const F distance = hn::Sqrt(hn::Add(hn::Mul(aside, aside), hn::Mul(above, above)));
  const Mask is_inside = hn::Le(max(beyond_side, beyond_cap), zero);
  const Mask by_cap = hn::Gt(beyond_cap, beyond_side);
  const F to_unit = hn::Div(one, distance);
  const F axial =
      hn::IfThenElse(is_inside, hn::IfThenElseZero(by_cap, one), hn::Mul(above, to_unit));
  return {hn::IfThenElse(is_inside, max(beyond_side, beyond_cap), distance),
          hn::IfThenElse(is_inside, hn::IfThenZeroElse(by_cap, one), hn::Mul(aside, to_unit)),
          hn::IfThenElse(hn::Lt(height, zero), hn::Neg(axial), axial)};
}

struct SphereCylinder {
  using A = SphereLanes;
  using B = CylinderLanes;
  static constexpr Units kUnits = Units::scaled;
  static constexpr Unsure kUnsure = Unsure::everything;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const SphereLanes& sphere,
                              const CylinderLanes& cylinder, Report& report) {
    const Rotation turn = rotation_of(pose.b);
    const F3 centre = rotate_back(turn, -pose.d);
    const WayOutLanes way = way_out_of_profile(centre, [&](F from_axis, F height) HWY_ATTR {
      return way_from_cylinder(cylinder, from_axis, height);
    });
    report_ball(centre, sphere.radius, cylinder.rounding, turn, way, report);
  }
};

void sphere_cylinder(const Batch& batch) { run_batch<SphereCylinder>(batch); }

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(sphere_cylinder);

void run_sphere_cylinder(const Batch& batch) { CAROM_DISPATCH(sphere_cylinder)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
