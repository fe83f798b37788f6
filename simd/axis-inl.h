// Selection of one of the three axes, lane by lane.
#if defined(CAROM_SIMD_AXIS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_SIMD_AXIS_INL_H_
#undef CAROM_SIMD_AXIS_INL_H_
#else
#define CAROM_SIMD_AXIS_INL_H_
#endif

#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

template <class V>
struct Mask3Of {
  MaskOf<V> x, y, z;
};
using Mask3 = Mask3Of<F>;

// Exactly one of the three is set in every lane.
template <class V>
using AxisMasksOf = Mask3Of<V>;
using AxisMasks = Mask3;

template <class V>
HWY_INLINE Lanes3<V> select(const Mask3Of<V>& mask, const Lanes3<V>& yes, const Lanes3<V>& no) {
  return {hn::IfThenElse(mask.x, yes.x, no.x), hn::IfThenElse(mask.y, yes.y, no.y),
          hn::IfThenElse(mask.z, yes.z, no.z)};
}

template <class V>
HWY_INLINE AxisMasksOf<V> first_of(MaskOf<V> x, MaskOf<V> y_not_z) {
  const MaskOf<V> y = hn::AndNot(x, y_not_z);
  return {x, y, hn::Not(hn::Or(x, y))};
}

// The axis of the least component; ties go to the first axis.
template <class V>
HWY_INLINE AxisMasksOf<V> least_axis(const Lanes3<V>& v) {
  return first_of<V>(hn::And(hn::Le(v.x, v.y), hn::Le(v.x, v.z)), hn::Le(v.y, v.z));
}

// The axis of the greatest component; ties go to the first axis.
template <class V>
HWY_INLINE AxisMasksOf<V> greatest_axis(const Lanes3<V>& v) {
  return first_of<V>(hn::And(hn::Ge(v.x, v.y), hn::Ge(v.x, v.z)), hn::Ge(v.y, v.z));
}

template <class V>
HWY_INLINE V pick(const AxisMasksOf<V>& axis, const Lanes3<V>& v) {
  return hn::IfThenElse(axis.x, v.x, hn::IfThenElse(axis.y, v.y, v.z));
}

// The unit vector along the axis, reversed where `negative`. The other components are +0.
template <class V>
HWY_INLINE Lanes3<V> signed_axis(const AxisMasksOf<V>& axis, const Mask3Of<V>& negative) {
  const V plus = splat_as<V>(1), minus = splat_as<V>(-1);
  const Lanes3<V> unit =
      select(negative, Lanes3<V>{minus, minus, minus}, Lanes3<V>{plus, plus, plus});
  return {hn::IfThenElseZero(axis.x, unit.x), hn::IfThenElseZero(axis.y, unit.y),
          hn::IfThenElseZero(axis.z, unit.z)};
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_SIMD_AXIS_INL_H_
