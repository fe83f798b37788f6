// Box along the world axes against triangle, seen from the centre of the box.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/aabb/aabb_triangle.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/features/box_triangle_core-inl.h"
#include "narrowphase/manifolds/manifold-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct AabbTriangleBase {
  using A = AabbLanes;
  using B = TriangleLanes;
  static constexpr Units kUnits = Units::scaled;
  static constexpr Unsure kUnsure = Unsure::in_lanes;

  template <class V>
  static HWY_INLINE Lanes3<V> half_of(const AabbOf<V>& box) {
    return (box.upper - box.lower) * splat_as<V>(0.5);
  }

  // The position of the triangle's body relative to the centre of the box.
  template <class V>
  static HWY_INLINE Lanes3<V> position_of(const PoseOf<V>& pose, const AabbOf<V>& box) {
    return ((pose.d - box.lower) + (pose.d - box.upper)) * splat_as<V>(0.5);
  }
};

struct AabbTriangle : AabbTriangleBase {
  static constexpr Columns kColumns = Columns::contact;

  template <class V, class Report>
  static HWY_INLINE void test(const PoseOf<V>& pose, const AabbOf<V>& box,
                              const TriangleOf<V>& triangle, Report& report) {
    const Lanes3<V> centre = (box.lower + box.upper) * splat_as<V>(0.5);
    const Lanes3<V> position = position_of(pose, box);
    PlacedTriangleOf<V> placed = place_triangle(triangle, rotation_of(pose.b), position);
    BoxContactOf<V> contact;
    box_triangle_contact(placed, half_of(box), contact);

    report(hn::Le(contact.separation, splat_as<V>(0)), hn::Or(contact.unsure, triangle.is_special),
           no_lanes_of<V>(), contact.separation, contact.normal, contact.on_box + centre,
           contact.on_other - position);
  }
};

// The kernel for Detail::overlap.
struct AabbTriangleDecision : AabbTriangleBase {
  static constexpr Columns kColumns = Columns::decision;

  template <class V, class Report>
  static HWY_INLINE void test(const PoseOf<V>& pose, const AabbOf<V>& box,
                              const TriangleOf<V>& triangle, Report& report) {
    // A certificate needs the normal and the witness points.
    if constexpr (std::is_same_v<V, D>) {
      if (report.marks_unsure()) return AabbTriangle::test(pose, box, triangle, report);
    }
    const PlacedTriangleOf<V> placed =
        place_triangle(triangle, rotation_of(pose.b), position_of(pose, box));
    report_decision(gap_of(placed, half_of(box)), triangle.is_special, report);
  }
};

void aabb_triangle(const Batch& batch) {
  if (batch.pass == Pass::manifold) return run_manifold<AabbLanes, TriangleLanes>(batch);
  if (batch.detail == Detail::overlap) return run_batch<AabbTriangleDecision>(batch);
  run_batch<AabbTriangle>(batch);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(aabb_triangle);

void run_aabb_triangle(const Batch& batch) { CAROM_DISPATCH(aabb_triangle)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
