// Convex shapes against a half-space, in lanes (Ericson 2005, 5.2.2 and 5.2.3). Reasons:
// halfspace_scalar.h.
#if defined(CAROM_NARROWPHASE_FEATURES_HALFSPACE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_FEATURES_HALFSPACE_INL_H_
#undef CAROM_NARROWPHASE_FEATURES_HALFSPACE_INL_H_
#else
#define CAROM_NARROWPHASE_FEATURES_HALFSPACE_INL_H_
#endif

#include "base/tolerances.h"
#include "narrowphase/batch/shape_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// The plane of a half-space that is turned by q, with its position at `d` from another body.
// `normal`: unit, in world axes. `height`: of the plane over the other body's position, along the
// normal. `size`: of the numbers that were rounded.
template <class V>
HWY_INLINE void place_plane(const HalfspaceOf<V>& halfspace, const QuaternionOf<V>& q,
                            const Lanes3<V>& d, Lanes3<V>& normal, V& height, V& size) {
  normal = rotate(rotation_of(q), halfspace.normal);
  const Lanes3<V> along = {hn::Mul(normal.x, d.x), hn::Mul(normal.y, d.y), hn::Mul(normal.z, d.z)};
  height = hn::Add(hn::Add(hn::Add(along.x, along.y), along.z), halfspace.offset);
  // If no rotation has rounded the normal, the sideways distance of the position adds no error.
  const MaskOf<V> is_turned = hn::Ne(sum_of_sizes(q.v), splat_as<V>(0));
  size = hn::Add(sum_of_sizes(select(is_turned, d, along)), hn::Abs(halfspace.offset));
}

// `size`: of the shape. Doubles decide all.
HWY_INLINE Mask is_unsure_over_plane(F separation, F size, F plane_size) {
  const F apart = hn::Abs(separation);
  const Mask near_touch =
      hn::Le(apart, hn::Mul(splat(kNearTouchScaled), hn::Add(plane_size, size)));
  const Mask far = hn::Lt(hn::Mul(splat(kFarPlane), hn::Add(apart, size)), plane_size);
  return hn::Or(near_touch, far);
}
HWY_INLINE DoubleMask is_unsure_over_plane(D, D, D) { return no_lanes_of<D>(); }

// Reports the shape (A) whose lowest point is `lowest`, relative to its own position, against the
// half-space (B) at `d` from it.
template <class V, class Report>
HWY_INLINE void report_over_plane(const Lanes3<V>& normal, V plane_size, V separation,
                                  const Lanes3<V>& lowest, V size, const Lanes3<V>& d,
                                  Report& report) {
  report(hn::Le(separation, splat_as<V>(0)), is_unsure_over_plane(separation, size, plane_size),
         no_lanes_of<V>(), separation, -normal, lowest, (lowest - normal * separation) - d);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_FEATURES_HALFSPACE_INL_H_
