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
  static constexpr Unsure kUnsure = Unsure::everything;

  static HWY_INLINE PlacedTriangle place(const PoseLanes& pose, const Rotation& turn_box,
                                         const B& triangle) {
    const Rotation turn = rotation_of(relative_rotation(pose.a, pose.b));
    return place_triangle(triangle, turn, rotate_back(turn_box, pose.d));
  }
};

struct BoxTriangle : BoxTriangleBase {
  static constexpr Columns kColumns = Columns::contact;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const A& box, const B& triangle,
                              Report& report) {
    const Rotation turn_box = rotation_of(pose.a);
    PlacedTriangle placed = place(pose, turn_box, triangle);
    BoxContact contact;
    box_triangle_contact(placed, box.half, contact);

    report(hn::Le(contact.separation, splat(0)), hn::Or(contact.unsure, triangle.is_special),
           no_lanes(), contact.separation, rotate(turn_box, contact.normal),
           rotate(turn_box, contact.on_box), rotate(turn_box, contact.on_other) - pose.d);
  }
};

// The kernel for Detail::overlap.
struct BoxTriangleDecision : BoxTriangleBase {
  static constexpr Columns kColumns = Columns::decision;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const A& box, const B& triangle,
                              Report& report) {
    const PlacedTriangle placed = place(pose, rotation_of(pose.a), triangle);
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
