// Box against triangle, in the frame of the box.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/box/box_triangle.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/features/box_triangle_core-inl.h"
#include "narrowphase/manifolds/manifold-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct BoxTriangleBase {
  using A = BoxLanes;
  using B = TriangleLanes;
  static constexpr Units kUnits = Units::scaled;
  static constexpr Unsure kUnsure = Unsure::in_lanes;

  template <class V>
  static HWY_INLINE PlacedTriangleOf<V> place(const PoseOf<V>& pose, const RotationOf<V>& turn_box,
                                              const TriangleOf<V>& triangle) {
    const RotationOf<V> turn = rotation_of(relative_rotation(pose.a, pose.b));
    return place_triangle(triangle, turn, rotate_back(turn_box, pose.d));
  }
};

struct BoxTriangle : BoxTriangleBase {
  static constexpr Columns kColumns = Columns::contact;

  template <class V, class Report>
  static HWY_INLINE void test(const PoseOf<V>& pose, const BoxOf<V>& box,
                              const TriangleOf<V>& triangle, Report& report) {
    const RotationOf<V> turn_box = rotation_of(pose.a);
    PlacedTriangleOf<V> placed = place(pose, turn_box, triangle);
    BoxContactOf<V> contact;
    box_triangle_contact(placed, box.half, contact);

    report(hn::Le(contact.separation, splat_as<V>(0)), hn::Or(contact.unsure, triangle.is_special),
           no_lanes_of<V>(), contact.separation, rotate(turn_box, contact.normal),
           rotate(turn_box, contact.on_box), rotate(turn_box, contact.on_other) - pose.d);
  }
};

// The kernel for Detail::overlap.
struct BoxTriangleDecision : BoxTriangleBase {
  static constexpr Columns kColumns = Columns::decision;

  template <class V, class Report>
  static HWY_INLINE void test(const PoseOf<V>& pose, const BoxOf<V>& box,
                              const TriangleOf<V>& triangle, Report& report) {
    // A certificate needs the normal and the witness points.
    if constexpr (std::is_same_v<V, D>) {
      if (report.marks_unsure()) return BoxTriangle::test(pose, box, triangle, report);
    }
    const PlacedTriangleOf<V> placed = place(pose, rotation_of(pose.a), triangle);
    report_decision(gap_of(placed, box.half), triangle.is_special, report);
  }
};

void box_triangle(const Batch& batch) {
  if (batch.pass == Pass::manifold) return run_manifold<BoxLanes, TriangleLanes>(batch);
  if (batch.detail == Detail::overlap) return run_batch<BoxTriangleDecision>(batch);
  run_batch<BoxTriangle>(batch);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(box_triangle);

void run_box_triangle(const Batch& batch) { CAROM_DISPATCH(box_triangle)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
