// Hull against half-space: the lowest point, or the mean of those that lie flat.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/hull/hull_halfspace.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/features/halfspace-inl.h"
#include "narrowphase/hulls/core_lanes-inl.h"
#include "narrowphase/manifolds/hull_points-inl.h"
#include "narrowphase/manifolds/manifold-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct HullHalfspace {
  using A = HullLanes;
  using B = HalfspaceLanes;
  static constexpr Units kUnits = Units::scaled;
  static constexpr Unsure kUnsure = Unsure::everything;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const A& hull, const B& halfspace,
                              Report& report) {
    F3 normal;
    F height, plane_size;
    place_plane(halfspace, pose.b, pose.d, normal, height, plane_size);
    const Rotation turn = rotation_of(pose.a);
    const F3 slope = rotate_back(turn, normal);
    const HullRecords records(hull);
    const F each = records.count_lanes();

    F least = splat(FLT_MAX);
    records.for_each_point(records.most(), [&](size_t, const F3& p) HWY_ATTR {
      least = min(least, dot(slope, p * hull.scaling));
    });
    const F size = hull.extent();
    const F low = hn::Add(least, hn::Mul(splat(kLyingFlat), size));
    F weight = splat(0);
    F3 sum = splat3(0);
    records.for_each_point(records.most(), [&](size_t i, const F3& p) HWY_ATTR {
      const F3 point = p * hull.scaling;
      const Mask has_point = hn::Lt(splat(static_cast<float>(i)), each);
      const Mask is_low = hn::And(has_point, hn::Le(dot(slope, point), low));
      weight = hn::IfThenElse(is_low, hn::Add(weight, splat(1)), weight);
      sum = select(is_low, sum + point, sum);
    });
    const F3 lowest = rotate(turn, sum * hn::Div(splat(1), weight));
    report_over_plane(normal, plane_size, hn::Sub(least, height), lowest, size, pose.d, report);
  }
};

void hull_halfspace(const Batch& batch) {
  if (batch.pass == Pass::manifold) return run_manifold<HullLanes, HalfspaceLanes>(batch);
  run_batch<HullHalfspace>(batch);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "narrowphase/pairs/manifold_batch.h"
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(hull_halfspace);

void run_hull_halfspace(const Batch& batch) {
  const auto in_lanes = CAROM_DISPATCH(hull_halfspace);
  if (batch.pass != Pass::manifold) return in_lanes(batch);
  run_manifolds(batch, ShapeKind::hull, ShapeKind::halfspace, in_lanes);
}

}  // namespace carom
#endif  // HWY_ONCE
