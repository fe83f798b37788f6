// Sphere against box, in the frame of the box (Ericson 2005, 5.1.4 and 5.2.5).
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/sphere/sphere_box.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/features/axis_search-inl.h"
#include "narrowphase/features/rounded-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct SphereBox {
  using A = SphereLanes;
  using B = BoxLanes;
  static constexpr Units kUnits = Units::scaled;
  static constexpr Unsure kUnsure = Unsure::everything;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const A& sphere, const B& box,
                              Report& report) {
    const Rotation turn = rotation_of(pose.b);
    const F3 centre = rotate_back(turn, -pose.d);
    const F3 way = beyond(centre, box.half);
    const F distance = hn::Sqrt(dot(way, way));
    const Mask inside = hn::Eq(largest_component(way), splat(0));

    // A centre inside the box leaves through the nearest face; normals lead out of the box.
    const F zero = splat(0);
    const F3 size = {hn::Abs(centre.x), hn::Abs(centre.y), hn::Abs(centre.z)};
    const F3 depth = box.half - size;
    const AxisMasks face = least_axis(depth);
    const Mask3 is_lower = {hn::Le(centre.x, zero), hn::Le(centre.y, zero), hn::Le(centre.z, zero)};
    const F gap = hn::IfThenElse(inside, hn::Neg(pick(face, depth)), distance);
    const F3 out = select(inside, signed_axis(face, is_lower), way * hn::Div(splat(1), distance));
    const F3 on_box = select(inside, centre - out * gap, centre - way);

    const F separation = hn::Sub(gap, sphere.radius);
    const F3 normal = -rotate(turn, out);
    // The squares of so short a vector vanish.
    const Mask vanishing = hn::AndNot(inside, hn::Le(distance, splat(kCoincident)));
    report(hn::Le(separation, zero), hn::Or(is_near_touch(separation), vanishing), no_lanes(),
           separation, normal, normal * sphere.radius, rotate(turn, on_box));
  }
};

void sphere_box(const Batch& batch) { run_batch<SphereBox>(batch); }

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(sphere_box);

void run_sphere_box(const Batch& batch) { CAROM_DISPATCH(sphere_box)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
