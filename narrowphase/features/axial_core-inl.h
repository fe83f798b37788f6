// Cylinders and segments about zero, and where two that are nearly parallel touch, in lanes.
// axial_core_scalar.h is the scalar form.
#if defined(CAROM_NARROWPHASE_FEATURES_AXIAL_CORE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_FEATURES_AXIAL_CORE_INL_H_
#undef CAROM_NARROWPHASE_FEATURES_AXIAL_CORE_INL_H_
#else
#define CAROM_NARROWPHASE_FEATURES_AXIAL_CORE_INL_H_
#endif

#include "narrowphase/features/round_tolerances.h"
#include "simd/lanes-inl.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

struct AxialCoreLanes {
  F3 axis;
  F half_length, rim;
};

HWY_INLINE F3 part_across(const F3& n, const F3& axis, F along) {
  const F3 across = n - axis * along;
  return across - axis * dot(axis, across);
}

HWY_INLINE F reach(const AxialCoreLanes& core, const F3& n) {
  const F along = dot(core.axis, n);
  const F3 across = n - core.axis * along;
  return hn::Add(hn::Mul(core.half_length, hn::Abs(along)),
                 hn::Mul(core.rim, hn::Sqrt(dot(across, across))));
}

HWY_INLINE F3 furthest_point(const AxialCoreLanes& core, const F3& n) {
  const F along = dot(core.axis, n);
  const F3 across = part_across(n, core.axis, along);
  const F over = hn::Div(splat(1), max(hn::Sqrt(dot(across, across)), splat(kLeastRim)));
  return core.axis * hn::CopySign(core.half_length, along) + across * hn::Mul(core.rim, over);
}

HWY_INLINE Mask holds(const AxialCoreLanes& core, const F3& p, float most = kBesideCore) {
  const F along = dot(core.axis, p);
  const F3 across = p - core.axis * along;
  const F reach = hn::Add(core.rim, splat(most));
  const Mask is_within = hn::And(hn::Le(hn::Abs(along), hn::Add(core.half_length, splat(most))),
                                 hn::Le(dot(across, across), hn::Mul(reach, reach)));
  return hn::And(hn::Ge(reach, splat(0)), is_within);
}

struct SpreadLanes {
  Mask is_disc, is_line;

  HWY_INLINE SpreadLanes(const AxialCoreLanes& core, const F3& n) {
    const F along = dot(core.axis, n);
    const F3 across = n - core.axis * along;
    const Mask is_end = hn::Gt(hn::Abs(along), splat(0.5f));
    const F of_disc = hn::Mul(core.rim, hn::Sqrt(dot(across, across)));
    const F of_line = hn::Mul(core.half_length, hn::Abs(along));
    is_disc = hn::And(is_end, hn::Le(of_disc, splat(kFlatTogether)));
    is_line = hn::AndNot(is_end, hn::Le(of_line, splat(kFlatTogether)));
  }
};

HWY_INLINE F middle_of_both(F half_a, F middle_b, F half_b) {
  const F low = max(hn::Neg(half_a), hn::Sub(middle_b, half_b));
  return hn::Mul(splat(0.5f), hn::Add(low, min(half_a, hn::Add(middle_b, half_b))));
}

HWY_INLINE F3 between_discs(const AxialCoreLanes& a, const AxialCoreLanes& b, const F3& n,
                            const F3& t) {
  const F3 aside = part_across(t, a.axis, dot(t, a.axis));
  const F apart = hn::Sqrt(dot(aside, aside));
  const F share = hn::Div(middle_of_both(a.rim, apart, b.rim), max(apart, splat(kLeastRim)));
  return a.axis * hn::CopySign(a.half_length, dot(a.axis, n)) + aside * share;
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_FEATURES_AXIAL_CORE_INL_H_
