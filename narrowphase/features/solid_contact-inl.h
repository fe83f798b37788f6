// The contact of a shape with faces (A) and a cylinder (B), in the frame of the former, in lanes.
// solid_contact_scalar.h is the scalar form and gives the same bits.
#if defined(CAROM_NARROWPHASE_FEATURES_SOLID_CONTACT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_FEATURES_SOLID_CONTACT_INL_H_
#undef CAROM_NARROWPHASE_FEATURES_SOLID_CONTACT_INL_H_
#else
#define CAROM_NARROWPHASE_FEATURES_SOLID_CONTACT_INL_H_
#endif

#include "base/tolerances.h"
#include "narrowphase/features/cylinders-inl.h"
#include "narrowphase/features/round_tolerances.h"
#include "narrowphase/features/solid_contact_scalar.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

HWY_INLINE F3 unit(const F3& v) {
  return v * hn::Div(splat(1), hn::Sqrt(max(dot(v, v), splat(kLeastWay))));
}

HWY_INLINE F3 way_from_corner(const F3& corner, const F3& middle, const AxialCoreLanes& core) {
  const F zero = splat(0), one = splat(1);
  const F3 p = corner - middle;
  const F along = dot(p, core.axis);
  const F3 across = p - core.axis * along;
  const F from_axis = hn::Sqrt(dot(across, across));
  const F above = hn::Sub(hn::Abs(along), core.half_length);
  const F beside = hn::Sub(from_axis, core.rim);
  const Mask is_at_rim = hn::Gt(min(above, beside), zero);
  const F share = hn::IfThenElse(is_at_rim, hn::Div(beside, max(from_axis, splat(kLeastRim))), one);
  const F rise = hn::IfThenElseZero(is_at_rim, hn::CopySign(above, along));
  return -unit(across * share + core.axis * rise);
}

struct SolidContactLanes {
  F separation;
  F3 normal, on_solid;
  Mask is_sure;
};

HWY_INLINE Mask is_unit(const F3& n) {
  return hn::Le(hn::Abs(hn::Sub(dot(n, n), splat(1))), splat(scalar::kUnitSquared));
}

template <class Report>
HWY_INLINE void report_solid(const SolidContactLanes& contact, const Rotation& turn,
                             const F3& offset, F rounding, const F3& d, Report& report) {
  const F separation = hn::Sub(contact.separation, rounding);
  const F3 normal = unit(rotate(turn, contact.normal));
  const F3 on_a = rotate(turn, contact.on_solid) + offset;
  const F3 on_b = (on_a + normal * separation) - d;
  const Mask is_sure = hn::And(hn::And(contact.is_sure, is_unit(contact.normal)),
                               hn::Gt(hn::Abs(separation), splat(kSureGap)));
  report(hn::Le(separation, splat(0)), hn::Not(is_sure), no_lanes(), separation, normal, on_a,
         on_b);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_FEATURES_SOLID_CONTACT_INL_H_
