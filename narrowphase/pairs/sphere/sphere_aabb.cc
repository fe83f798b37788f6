// Sphere against axis-aligned box: by the point of the box nearest to the centre (Ericson 2005,
// 5.2.5), or through the nearest face if the centre is inside.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/sphere/sphere_aabb.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/features/ball-inl.h"
#include "simd/axis-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct SphereAabb {
  using A = SphereLanes;
  using B = AabbLanes;
  static constexpr Units kUnits = Units::metres;
  static constexpr Unsure kUnsure = Unsure::separation;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const A& sphere, const B& box,
                              Report& report) {
    const F3 centre = -pose.d;  // in the frame of the box
    const F3 nearest = min(max(centre, box.lower), box.upper);
    const Length outside = measure(clamp_to_finite(nearest - centre));
    const Mask inside = outside.is_zero;

    // A centre inside the box leaves through the nearest face; ties go to the first axis and its
    // lower side. The normal points into the box, against the penetration direction.
    const F3 below = centre - box.lower;
    const F3 above = box.upper - centre;
    const F3 way_out = min(below, above);
    const AxisMasks axis = least_axis(way_out);
    const Mask3 upwards = {hn::Lt(above.x, below.x), hn::Lt(above.y, below.y),
                           hn::Lt(above.z, below.z)};
    const F3 exit = select(axis, select(upwards, box.upper, box.lower), nearest);

    const F gap = hn::IfThenElse(inside, hn::Neg(pick(axis, way_out)), outside.length);
    const F separation = hn::Sub(gap, sphere.radius);
    const F3 normal = select(inside, signed_axis(axis, upwards), outside.direction);
    const F size = hn::Add(largest_component(pose.d), sphere.radius);
    const Mask near_touch = hn::Le(hn::Abs(separation), hn::Mul(size, splat(kNearTouch)));
    report(hn::Le(separation, splat(0)), near_touch, no_lanes(), separation, normal,
           normal * sphere.radius, select(inside, exit, nearest));
  }

  static HWY_INLINE D exact_separation(const D3& d, const SphereOf<D>& sphere, const AabbOf<D>& box,
                                       DoubleMask& is_proven) {
    const D3 centre = -d;
    const D3 way = min(max(centre, box.lower), box.upper) - centre;
    const D3 exits = min(centre - box.lower, box.upper - centre);
    const D exit = min(min(exits.x, exits.y), exits.z);
    const D zero = splat_double(0);
    const D squared_distance = dot(way, way);
    const D separation =
        hn::IfThenElse(hn::Gt(squared_distance, zero), gap_to_ball(squared_distance, sphere.radius),
                       hn::Sub(zero, hn::Add(exit, sphere.radius)));
    const D size = max(max(largest_component(d), box.extent()), sphere.radius);
    is_proven = hn::Gt(hn::Abs(separation), hn::Mul(size, splat_double(kProvenGap)));
    return separation;
  }
};

void sphere_aabb(const Batch& batch) { run_batch<SphereAabb>(batch); }

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(sphere_aabb);

void run_sphere_aabb(const Batch& batch) { CAROM_DISPATCH(sphere_aabb)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
