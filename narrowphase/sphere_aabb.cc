// Sphere against axis-aligned box: by the point of the box nearest to the centre (Ericson 2005,
// 5.2.5), or out through the nearest face if the centre is inside.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/sphere_aabb.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch-inl.h"
#include "simd/axis-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct SphereAabb {
  using A = SphereLanes;
  using B = BoxLanes;

  static HWY_INLINE HitLanes test(const F3& relative, const A& sphere, const B& box) {
    const F3 centre = -relative;  // in the frame of the box
    const F3 nearest = min(max(centre, box.lower), box.upper);
    const Length outside = measure(clamp_to_finite(nearest - centre));
    const Exit exit = nearest_face(centre, nearest, box);

    const Mask inside = outside.is_zero;
    const F gap = hn::IfThenElse(inside, hn::Neg(exit.depth), outside.length);
    const F3 normal = select(inside, exit.normal, outside.direction);
    const F separation = hn::Sub(gap, sphere.radius);
    return {.overlap = hn::Le(separation, splat(0)),
            .separation = separation,
            .normal = normal,
            .arm_a = normal * sphere.radius,
            .arm_b = select(inside, exit.point, nearest),
            .degenerate = no_lanes()};
  }

 private:
  // How a centre inside the box leaves it: the way to the nearest face, ties to the first axis and
  // to its lower side.
  struct Exit {
    F depth;
    F3 normal;  // from the sphere into the box: against the way out
    F3 point;   // on that face
  };

  static HWY_INLINE Exit nearest_face(const F3& centre, const F3& nearest, const BoxLanes& box) {
    const F3 below = centre - box.lower;
    const F3 above = box.upper - centre;
    const F3 way = min(below, above);
    const AxisMasks axis = least_axis(way);
    const Mask3 upwards = {hn::Lt(above.x, below.x), hn::Lt(above.y, below.y),
                           hn::Lt(above.z, below.z)};
    return {.depth = pick(axis, way),
            .normal = signed_axis(axis, upwards),
            .point = select(axis, select(upwards, box.upper, box.lower), nearest)};
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
