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
  static constexpr Unsure kUnsure = Unsure::in_lanes;

  template <class V, class Report>
  static HWY_INLINE void test(const PoseOf<V>& pose, const SphereOf<V>& sphere, const BoxOf<V>& box,
                              Report& report) {
    const RotationOf<V> turn = rotation_of(pose.b);
    const Lanes3<V> centre = rotate_back(turn, -pose.d);
    const Lanes3<V> way = beyond(centre, box.half);
    const V distance = hn::Sqrt(dot(way, way));
    const MaskOf<V> inside = hn::Eq(largest_component(way), splat_as<V>(0));

    // A centre inside the box leaves through the nearest face; normals lead out of the box.
    const V zero = splat_as<V>(0);
    const Lanes3<V> size = {hn::Abs(centre.x), hn::Abs(centre.y), hn::Abs(centre.z)};
    const Lanes3<V> depth = box.half - size;
    const AxisMasksOf<V> face = least_axis(depth);
    const Mask3Of<V> is_lower = {hn::Le(centre.x, zero), hn::Le(centre.y, zero),
                                 hn::Le(centre.z, zero)};
    const V gap = hn::IfThenElse(inside, hn::Neg(pick(face, depth)), distance);
    const Lanes3<V> out =
        select(inside, signed_axis(face, is_lower), way * hn::Div(splat_as<V>(1), distance));
    const Lanes3<V> on_box = select(inside, centre - out * gap, centre - way);

    const V separation = hn::Sub(gap, sphere.radius);
    const Lanes3<V> normal = -rotate(turn, out);
    // The squares of so short a vector vanish.
    const MaskOf<V> vanishing = hn::AndNot(inside, hn::Le(distance, splat_as<V>(kCoincident)));
    report(hn::Le(separation, zero), hn::Or(is_near_touch(separation), vanishing), no_lanes_of<V>(),
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
