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
  static constexpr Unsure kUnsure = Unsure::everything;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const A& sphere, const B& triangle,
                              Report& report) {
    const Rotation turn = rotation_of(pose.b);
    const TriangleCore core(triangle.a, triangle.b, triangle.c);
    F3 local;
    F distance;
    const Mask is_face = nearest_on_triangle(rotate_back(turn, -pose.d), core, local, distance);

    // So near to an edge, the vector to it is mostly rounding: double precision decides.
    const Mask is_near_edge =
        hn::AndNot(is_face, hn::Le(distance, splat(CoreTolerance<float>::kNearEdges)));
    const F3 way = rotate(turn, local);
    const F3 normal = way * hn::Div(splat(1), hn::Sqrt(dot(way, way)));
    report_grown(splat3(0), normal * distance, normal, distance, sphere.radius, splat(0), pose,
                 hn::Or(is_near_edge, triangle.is_special), no_lanes(), report);
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
