// Half-space against a round shape, in lanes: each shape has a lowest_point(), as in
// round_over_plane_scalar.h.
#if defined(CAROM_NARROWPHASE_PAIRS_HALFSPACE_ROUND_OVER_PLANE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_PAIRS_HALFSPACE_ROUND_OVER_PLANE_INL_H_
#undef CAROM_NARROWPHASE_PAIRS_HALFSPACE_ROUND_OVER_PLANE_INL_H_
#else
#define CAROM_NARROWPHASE_PAIRS_HALFSPACE_ROUND_OVER_PLANE_INL_H_
#endif

#include "narrowphase/features/halfspace-inl.h"
#include "narrowphase/pairs/round/round_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

template <class V>
struct LowestPointOf {
  V height;
  Lanes3<V> point;
};

template <class Round>
struct HalfspaceRound {
  using A = HalfspaceLanes;
  using B = Round;
  static constexpr Units kUnits = Units::scaled;
  static constexpr Unsure kUnsure = Unsure::in_lanes;

  template <class V, class Shape, class Report>
  static HWY_INLINE void test(const PoseOf<V>& pose, const HalfspaceOf<V>& halfspace,
                              const Shape& shape, Report& report) {
    Lanes3<V> normal;
    V height, plane_size;
    place_plane(halfspace, pose.a, -pose.d, normal, height, plane_size);
    const RotationOf<V> turn = rotation_of(pose.b);
    const V size = shape.extent();
    const LowestPointOf<V> low =
        lowest_point(shape, rotate_back(turn, normal), hn::Mul(splat_as<V>(kLyingFlat), size));
    const Lanes3<V> lowest = rotate(turn, low.point) - normal * shape.rounding;
    const V separation = hn::Sub(hn::Sub(low.height, height), shape.rounding);
    report(hn::Le(separation, splat_as<V>(0)), is_unsure_over_plane(separation, size, plane_size),
           no_lanes_of<V>(), separation, normal, (lowest - normal * separation) + pose.d, lowest);
  }
};

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_PAIRS_HALFSPACE_ROUND_OVER_PLANE_INL_H_
