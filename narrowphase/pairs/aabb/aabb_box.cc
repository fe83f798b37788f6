// Box along the world axes against an oriented box, by the separating axis theorem.
#include <type_traits>

#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/aabb/aabb_box.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/features/boxes_contact-inl.h"
#include "narrowphase/features/boxes_decision-inl.h"
#include "narrowphase/manifolds/manifold-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct AabbBoxBase {
  using A = AabbLanes;
  using B = BoxLanes;
  static constexpr Units kUnits = Units::scaled;

  // Subtracts both corners before it takes the mean, so that a box far from its position loses no
  // digits.
  template <class V>
  static HWY_INLINE BoxPairOf<V> boxes(const PoseOf<V>& pose, const AabbOf<V>& a,
                                       const BoxOf<V>& b) {
    const V half = splat_as<V>(0.5);
    return {((pose.d - a.lower) + (pose.d - a.upper)) * half, rotation_of(pose.b),
            (a.upper - a.lower) * half, b.half};
  }
  template <class V>
  static HWY_INLINE Lanes3<V> centre(const AabbOf<V>& a) {
    return (a.lower + a.upper) * splat_as<V>(0.5);
  }
  template <class V>
  static HWY_INLINE RotationOf<V> world() {
    const V zero = splat_as<V>(0);
    const V one = splat_as<V>(1);
    return {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}};
  }
};

struct AabbBox : AabbBoxBase {
  static constexpr bool kTestFetches = true;
  static constexpr Unsure kUnsure = Unsure::test;

  template <class V, class Report>
  static HWY_INLINE void test(const PoseOf<V>& pose, const AabbOf<V>& a, const BoxOf<V>& b,
                              Report& report) {
    test_boxes(boxes(pose, a, b), world<V>(), centre(a), report);
  }
};

// The decision alone, where its sign is all that is asked for.
struct AabbBoxDecision : AabbBox {
  static constexpr Columns kColumns = Columns::decision;

  template <class V, class Report>
  static HWY_INLINE void test(const PoseOf<V>& pose, const AabbOf<V>& a, const BoxOf<V>& b,
                              Report& report) {
    if constexpr (std::is_same_v<V, F>) {
      decide_boxes(boxes(pose, a, b), report);
    } else {
      AabbBox::test(pose, a, b, report);
    }
  }
};

struct AabbBoxDistance : AabbBoxBase {
  static constexpr Unsure kUnsure = Unsure::in_lanes;
  static constexpr Columns kColumns = Columns::contact;

  template <class V, class Report>
  static HWY_INLINE void test(const PoseOf<V>& pose, const AabbOf<V>& a, const BoxOf<V>& b,
                              Report& report) {
    measure_boxes(boxes(pose, a, b), world<V>(), centre(a), report);
  }
};

void aabb_box(const Batch& batch) {
  switch (batch.pass) {
    case Pass::test:
      return is_plain_decision(batch) ? run_batch<AabbBoxDecision>(batch)
                                      : run_batch<AabbBox>(batch);
    case Pass::distance:
      return run_batch<AabbBoxDistance>(batch);
    case Pass::manifold:
      return run_manifold<AabbLanes, BoxLanes>(batch);
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

HWY_EXPORT(aabb_box);

void run_aabb_box(const Batch& batch) { CAROM_DISPATCH(aabb_box)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
