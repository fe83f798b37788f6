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
  static constexpr Unsure kUnsure = Unsure::everything;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const A& halfspace, const B& triangle,
                              Report& report) {
    F3 normal;
    F height, plane_size;
    place_plane(halfspace, pose.a, -pose.d, normal, height, plane_size);
    const Rotation turn = rotation_of(pose.b);
    const F3 a = rotate(turn, triangle.a);
    const F3 b = rotate(turn, triangle.b);
    const F3 c = rotate(turn, triangle.c);
    const F height_a = dot(normal, a);
    const F height_b = dot(normal, b);
    const F height_c = dot(normal, c);
    const F least = min(min(height_a, height_b), height_c);
    const F separation = hn::Sub(least, height);

    // The mean of the corners that are as low as the lowest.
    const F size = triangle.extent();
    const F low = hn::Add(least, hn::Mul(splat(kLyingFlat), size));
    const F weight_a = hn::IfThenElseZero(hn::Le(height_a, low), splat(1));
    const F weight_b = hn::IfThenElseZero(hn::Le(height_b, low), splat(1));
    const F weight_c = hn::IfThenElseZero(hn::Le(height_c, low), splat(1));
    const F weight = hn::Add(hn::Add(weight_a, weight_b), weight_c);
    const F3 lowest = ((a * weight_a + b * weight_b) + c * weight_c) * hn::Div(splat(1), weight);

    const Mask unsure = is_unsure_over_plane(separation, size, plane_size);
    report(hn::Le(separation, splat(0)), hn::Or(unsure, triangle.is_special), no_lanes(),
           separation, normal, (lowest - normal * separation) + pose.d, lowest);
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
