// Nearest points of segments in lanes (Ericson 2005, 5.1.2, 5.1.9).
#if defined(CAROM_NARROWPHASE_FEATURES_SEGMENT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_FEATURES_SEGMENT_INL_H_
#undef CAROM_NARROWPHASE_FEATURES_SEGMENT_INL_H_
#else
#define CAROM_NARROWPHASE_FEATURES_SEGMENT_INL_H_
#endif

#include "base/tolerances.h"
#include "simd/axis-inl.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// a / b clamped to [0, 1]; 0 unless b > 0.
template <class V>
HWY_INLINE V clamped_ratio(V a, V b) {
  return hn::IfThenElseZero(hn::Gt(b, splat_as<V>(0)),
                            clamp(hn::Div(a, b), splat_as<V>(0), splat_as<V>(1)));
}

// Whether the parameter t of a segment is at neither end.
template <class V>
HWY_INLINE MaskOf<V> is_inside(V t) {
  return hn::And(hn::Gt(t, splat_as<V>(0)), hn::Lt(t, splat_as<V>(1)));
}

// The point of the segment from a to b that is nearest to p, and the vector to it. If the point is
// not an end (`is_across`), the vector is made perpendicular to the segment: what rounding leaves
// along the segment would tilt the normal.
template <class V>
HWY_INLINE void nearest_on_segment(const Lanes3<V>& p, const Lanes3<V>& a, const Lanes3<V>& b,
                                   Lanes3<V>& point, Lanes3<V>& delta, MaskOf<V>& is_across) {
  const Lanes3<V> d = b - a;
  const V squared = dot(d, d);
  const V t = clamped_ratio(dot(p - a, d), squared);
  point = a + d * t;
  const Lanes3<V> way = point - p;
  is_across = is_inside(t);
  delta = select(is_across, way - d * hn::Div(dot(way, d), squared), way);
}

// The parameters s and t at which p + d s and q + e t are nearest (r = q - p), and the vector
// between the two points. The form of the first s keeps the error of the distance at that of the
// coordinates, however nearly parallel the segments are.
template <class V>
HWY_INLINE void nearest_of_segments(const Lanes3<V>& r, const Lanes3<V>& d, V dd,
                                    const Lanes3<V>& e, V ee, V& s, V& t, Lanes3<V>& delta) {
  const Lanes3<V> n = cross(d, e);
  const V along_lines = clamped_ratio(dot(cross(r, e), n), dot(n, n));
  t = clamped_ratio(dot(e, d * along_lines - r), ee);
  s = clamped_ratio(dot(d, r + e * t), dd);
  delta = (r + e * t) - d * s;
}

// Recomputes the direction of `delta`, not a unit vector, from the nearest features: perpendicular
// to both segments if both points are inside them (its sign is arbitrary), perpendicular to one if
// only that point is. Returns the lanes in which it is perpendicular to both.
template <class V>
HWY_INLINE MaskOf<V> way_between(const Lanes3<V>& d, V dd, const Lanes3<V>& e, V ee, V s, V t,
                                 const Lanes3<V>& delta, Lanes3<V>& way) {
  using Tolerance = CoreTolerance<hn::TFromV<V>>;
  const Lanes3<V> n = cross(d, e);
  const V least = max(hn::Mul(splat_as<V>(Tolerance::kParallel), hn::Mul(dd, ee)),
                      splat_as<V>(Tolerance::kVanishing));
  const MaskOf<V> in_d = is_inside(s);
  const MaskOf<V> in_e = is_inside(t);
  const MaskOf<V> across = hn::And(hn::And(in_d, in_e), hn::Gt(dot(n, n), least));
  way = select(across, n, delta);
  // Removes what rounding left along the segment. Once perpendicular to d, n is perpendicular to e
  // up to rounding.
  const Lanes3<V> edge = select(in_d, d, e);
  const V share = hn::Div(dot(way, edge), hn::IfThenElse(in_d, dd, ee));
  way = select(hn::Or(in_d, in_e), way - edge * share, way);
  return across;
}

// Some unit vector perpendicular to d; +x if d is zero.
HWY_INLINE F3 any_perpendicular(const F3& d) {
  const AxisMasks axis = least_axis(F3{hn::Abs(d.x), hn::Abs(d.y), hn::Abs(d.z)});
  const F zero = splat(0);
  const F3 around_x = {zero, hn::Neg(d.z), d.y};
  const F3 around_y = {d.z, zero, hn::Neg(d.x)};
  const F3 around_z = {hn::Neg(d.y), d.x, zero};
  const F3 v = select(axis.x, around_x, select(axis.y, around_y, around_z));
  const F squared = dot(v, v);
  const F3 x = {splat(1), zero, zero};
  return select(hn::Gt(squared, zero), v * hn::Div(splat(1), hn::Sqrt(squared)), x);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_FEATURES_SEGMENT_INL_H_
