// Oriented box against oriented box, by the separating axis theorem.
#include <type_traits>

#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/box/box_box.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/features/boxes_contact-inl.h"
#include "narrowphase/features/boxes_decision-inl.h"
#include "narrowphase/manifolds/manifold-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct BoxBoxBase {
  using A = BoxLanes;
  using B = BoxLanes;
  static constexpr Units kUnits = Units::scaled;

  template <class V>
  static HWY_INLINE BoxPairOf<V> boxes(const PoseOf<V>& pose, const RotationOf<V>& turn_a,
                                       const BoxOf<V>& a, const BoxOf<V>& b) {
    return {rotate_back(turn_a, pose.d), rotation_of(relative_rotation(pose.a, pose.b)), a.half,
            b.half};
  }
};

struct BoxBox : BoxBoxBase {
  static constexpr bool kTestFetches = true;
  static constexpr Unsure kUnsure = Unsure::test;

  template <class V, class Report>
  static HWY_INLINE void test(const PoseOf<V>& pose, const BoxOf<V>& a, const BoxOf<V>& b,
                              Report& report) {
    const RotationOf<V> turn_a = rotation_of(pose.a);
    const V zero = splat_as<V>(0);
    test_boxes(boxes(pose, turn_a, a, b), turn_a, {zero, zero, zero}, report);
  }
};

// The decision alone, where its sign is all that is asked for.
struct BoxBoxDecision : BoxBox {
  static constexpr Columns kColumns = Columns::decision;

  template <class V, class Report>
  static HWY_INLINE void test(const PoseOf<V>& pose, const BoxOf<V>& a, const BoxOf<V>& b,
                              Report& report) {
    if constexpr (std::is_same_v<V, F>) {
      decide_boxes(boxes(pose, rotation_of(pose.a), a, b), report);
    } else {
      BoxBox::test(pose, a, b, report);
    }
  }
};

struct BoxBoxDistance : BoxBoxBase {
  static constexpr Unsure kUnsure = Unsure::in_lanes;
  static constexpr Columns kColumns = Columns::contact;

  template <class V, class Report>
  static HWY_INLINE void test(const PoseOf<V>& pose, const BoxOf<V>& a, const BoxOf<V>& b,
                              Report& report) {
    const RotationOf<V> turn_a = rotation_of(pose.a);
    const V zero = splat_as<V>(0);
    measure_boxes(boxes(pose, turn_a, a, b), turn_a, {zero, zero, zero}, report);
  }
};

void box_box(const Batch& batch) {
  switch (batch.pass) {
    case Pass::test:
      return is_plain_decision(batch) ? run_batch<BoxBoxDecision>(batch) : run_batch<BoxBox>(batch);
    case Pass::distance:
      return run_batch<BoxBoxDistance>(batch);
    case Pass::manifold:
      return run_manifold<BoxLanes, BoxLanes>(batch);
    case Pass::clearance:  // these are only for GJK kinds
    case Pass::recall:
    case Pass::shell:
    case Pass::balls:
    case Pass::direction:
      return;
  }
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(box_box);

void run_box_box(const Batch& batch) { CAROM_DISPATCH(box_box)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
