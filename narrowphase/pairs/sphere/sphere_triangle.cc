// Sphere against triangle: the centre against the triangle in its frame (Ericson 2005, 5.1.5).
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/sphere/sphere_triangle.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/features/rounded-inl.h"
#include "narrowphase/features/triangle-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct SphereTriangle {
  using A = SphereLanes;
  using B = TriangleLanes;
  static constexpr Units kUnits = Units::scaled;
  static constexpr Unsure kUnsure = Unsure::in_lanes;

  template <class V, class Report>
  static HWY_INLINE void test(const PoseOf<V>& pose, const SphereOf<V>& sphere,
                              const TriangleOf<V>& triangle, Report& report) {
    const RotationOf<V> turn = rotation_of(pose.b);
    const TriangleCoreOf<V> core(triangle.a, triangle.b, triangle.c);
    Lanes3<V> local;
    V distance;
    const MaskOf<V> is_face =
        nearest_on_triangle(rotate_back(turn, -pose.d), core, local, distance);

    // So near to an edge, the vector to it is mostly rounding: double precision decides.
    const MaskOf<V> is_near_edge = hn::AndNot(
        is_face, hn::Le(distance, splat_as<V>(CoreTolerance<hn::TFromV<V>>::kNearEdges)));
    const Lanes3<V> way = rotate(turn, local);
    const Lanes3<V> normal = way * hn::Div(splat_as<V>(1), hn::Sqrt(dot(way, way)));
    report_grown(Lanes3<V>{splat_as<V>(0), splat_as<V>(0), splat_as<V>(0)}, normal * distance,
                 normal, distance, sphere.radius, splat_as<V>(0), pose,
                 hn::Or(is_near_edge, triangle.is_special), no_lanes_of<V>(), report);
  }
};

void sphere_triangle(const Batch& batch) { run_batch<SphereTriangle>(batch); }

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(sphere_triangle);

void run_sphere_triangle(const Batch& batch) { CAROM_DISPATCH(sphere_triangle)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
