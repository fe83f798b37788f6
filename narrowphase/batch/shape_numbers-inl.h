// The numbers of shapes, in lanes of floats or of doubles.
//   extent()    the greatest coordinate
//   scale(V s)  makes the shape s times as large
#if defined(CAROM_NARROWPHASE_BATCH_SHAPE_NUMBERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_BATCH_SHAPE_NUMBERS_INL_H_
#undef CAROM_NARROWPHASE_BATCH_SHAPE_NUMBERS_INL_H_
#else
#define CAROM_NARROWPHASE_BATCH_SHAPE_NUMBERS_INL_H_
#endif

#include "carom/shapes/shape.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

template <class V>
HWY_INLINE V sum_of_sizes(const Lanes3<V>& v) {
  return hn::Add(hn::Add(hn::Abs(v.x), hn::Abs(v.y)), hn::Abs(v.z));
}

template <class V>
struct SphereOf {
  V radius;

  HWY_INLINE V extent() const { return radius; }
  HWY_INLINE void scale(V s) { radius = hn::Mul(radius, s); }
};

template <class V>
struct AabbOf {
  Lanes3<V> lower, upper;

  HWY_INLINE V extent() const { return max(largest_component(lower), largest_component(upper)); }
  HWY_INLINE void scale(V s) {
    lower = lower * s;
    upper = upper * s;
  }
};

template <class V>
struct CapsuleOf {
  Lanes3<V> a, b;
  V radius;

  HWY_INLINE V extent() const {
    return max(max(largest_component(a), largest_component(b)), radius);
  }
  HWY_INLINE void scale(V s) {
    a = a * s;
    b = b * s;
    radius = hn::Mul(radius, s);
  }
};

template <class V>
struct BoxOf {
  Lanes3<V> half;

  HWY_INLINE V extent() const { return max(max(half.x, half.y), half.z); }
  HWY_INLINE void scale(V s) { half = half * s; }
};

// Cylinders and cones: the rim is this far from the axis, and so far from the middle.
template <class V, ShapeKind kRound>
struct RimOf {
  V radius, half_length, rounding;

  HWY_INLINE V extent() const { return max(max(radius, half_length), rounding); }
  HWY_INLINE void scale(V s) {
    radius = hn::Mul(radius, s);
    half_length = hn::Mul(half_length, s);
    rounding = hn::Mul(rounding, s);
  }
};

template <class V>
struct EllipsoidOf {
  Lanes3<V> semi_axes;
  V rounding;

  HWY_INLINE V extent() const { return max(largest_component(semi_axes), rounding); }
  HWY_INLINE void scale(V s) {
    semi_axes = semi_axes * s;
    rounding = hn::Mul(rounding, s);
  }
};

template <class V>
struct TriangleOf {
  Lanes3<V> a, b, c;
  MaskOf<V> is_special;  // thick, one-sided or with inner edges: for the scalar form

  HWY_INLINE V extent() const {
    return max(max(largest_component(a), largest_component(b)), largest_component(c));
  }
  HWY_INLINE void scale(V s) {
    a = a * s;
    b = b * s;
    c = c * s;
  }
};

template <class V>
struct HalfspaceOf {
  Lanes3<V> normal;
  V offset;

  // The normal is `down` times as long as stated.
  HWY_INLINE void make_unit(V down) {
    const V length = hn::Sqrt(dot(normal, normal));
    normal = normal * hn::Div(splat_as<V>(1), length);
    offset = hn::Div(hn::Mul(offset, down), length);
  }
  HWY_INLINE V extent() const { return hn::Abs(offset); }
  HWY_INLINE void scale(V s) { offset = hn::Mul(offset, s); }
};

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_BATCH_SHAPE_NUMBERS_INL_H_
