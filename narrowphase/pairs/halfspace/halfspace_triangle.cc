// Half-space against triangle: the lowest corner, or the middle of the edge or face that lies flat.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/halfspace/halfspace_triangle.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/features/halfspace-inl.h"
#include "narrowphase/manifolds/manifold-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct HalfspaceTriangle {
  using A = HalfspaceLanes;
  using B = TriangleLanes;
  static constexpr Units kUnits = Units::scaled;
  static constexpr Unsure kUnsure = Unsure::in_lanes;

  template <class V, class Report>
  static HWY_INLINE void test(const PoseOf<V>& pose, const HalfspaceOf<V>& halfspace,
                              const TriangleOf<V>& triangle, Report& report) {
    Lanes3<V> normal;
    V height, plane_size;
    place_plane(halfspace, pose.a, -pose.d, normal, height, plane_size);
    const RotationOf<V> turn = rotation_of(pose.b);
    const Lanes3<V> a = rotate(turn, triangle.a);
    const Lanes3<V> b = rotate(turn, triangle.b);
    const Lanes3<V> c = rotate(turn, triangle.c);
    const V height_a = dot(normal, a);
    const V height_b = dot(normal, b);
    const V height_c = dot(normal, c);
    const V least = min(height_c, min(height_b, height_a));  // of equal ones the first
    const V separation = hn::Sub(least, height);

    // The mean of the corners that are as low as the lowest.
    const V size = triangle.extent();
    const V low = hn::Add(least, hn::Mul(splat_as<V>(kLyingFlat), size));
    const V weight_a = hn::IfThenElseZero(hn::Le(height_a, low), splat_as<V>(1));
    const V weight_b = hn::IfThenElseZero(hn::Le(height_b, low), splat_as<V>(1));
    const V weight_c = hn::IfThenElseZero(hn::Le(height_c, low), splat_as<V>(1));
    const V weight = hn::Add(hn::Add(weight_a, weight_b), weight_c);
    const Lanes3<V> lowest =
        ((a * weight_a + b * weight_b) + c * weight_c) * hn::Div(splat_as<V>(1), weight);

    const MaskOf<V> unsure = is_unsure_over_plane(separation, size, plane_size);
    report(hn::Le(separation, splat_as<V>(0)), hn::Or(unsure, triangle.is_special),
           no_lanes_of<V>(), separation, normal, (lowest - normal * separation) + pose.d, lowest);
  }
};

void halfspace_triangle(const Batch& batch) {
  if (batch.pass == Pass::manifold) return run_manifold<HalfspaceLanes, TriangleLanes>(batch);
  run_batch<HalfspaceTriangle>(batch);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(halfspace_triangle);

void run_halfspace_triangle(const Batch& batch) { CAROM_DISPATCH(halfspace_triangle)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
