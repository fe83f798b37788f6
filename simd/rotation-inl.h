// Products of vectors, quaternions and rotations, in lanes.
#if defined(CAROM_SIMD_ROTATION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_SIMD_ROTATION_INL_H_
#undef CAROM_SIMD_ROTATION_INL_H_
#else
#define CAROM_SIMD_ROTATION_INL_H_
#endif

#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

template <class V>
HWY_INLINE V dot(const Lanes3<V>& a, const Lanes3<V>& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

template <class V>
HWY_INLINE Lanes3<V> cross(const Lanes3<V>& a, const Lanes3<V>& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)),
          hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}

template <class V>
HWY_INLINE Lanes3<V> negate_if(MaskOf<V> mask, const Lanes3<V>& v) {
  return select(mask, -v, v);
}

template <class V>
HWY_INLINE V clamp(V v, V low, V high) {
  return min(max(v, low), high);
}

// x, y, z, w; of any length but zero.
template <class V>
struct QuaternionOf {
  Lanes3<V> v;
  V w;
};
using Quaternion = QuaternionOf<F>;

template <class V>
HWY_INLINE V squared_norm(const QuaternionOf<V>& q) {
  return hn::Add(dot(q.v, q.v), hn::Mul(q.w, q.w));
}

// Columns: the rotated axes.
template <class V>
struct RotationOf {
  Lanes3<V> x, y, z;
};
using Rotation = RotationOf<F>;

// M(q) / |q|^2.
template <class V>
HWY_INLINE RotationOf<V> rotation_of(const QuaternionOf<V>& q) {
  const hn::DFromV<V> tag;
  const V one = hn::Set(tag, 1);
  const V s = hn::Div(hn::Set(tag, 2), squared_norm(q));
  const Lanes3<V> scaled = q.v * s;
  const V xx = hn::Mul(q.v.x, scaled.x);
  const V xy = hn::Mul(q.v.x, scaled.y);
  const V xz = hn::Mul(q.v.x, scaled.z);
  const V yy = hn::Mul(q.v.y, scaled.y);
  const V yz = hn::Mul(q.v.y, scaled.z);
  const V zz = hn::Mul(q.v.z, scaled.z);
  const V wx = hn::Mul(q.w, scaled.x);
  const V wy = hn::Mul(q.w, scaled.y);
  const V wz = hn::Mul(q.w, scaled.z);
  return {{hn::Sub(one, hn::Add(yy, zz)), hn::Add(xy, wz), hn::Sub(xz, wy)},
          {hn::Sub(xy, wz), hn::Sub(one, hn::Add(xx, zz)), hn::Add(yz, wx)},
          {hn::Add(xz, wy), hn::Sub(yz, wx), hn::Sub(one, hn::Add(xx, yy))}};
}

// conj(a) * b: rotates from the frame of b to that of a.
template <class V>
HWY_INLINE QuaternionOf<V> relative_rotation(const QuaternionOf<V>& a, const QuaternionOf<V>& b) {
  return {(b.v * a.w - a.v * b.w) - cross(a.v, b.v), hn::Add(hn::Mul(a.w, b.w), dot(a.v, b.v))};
}

template <class V>
HWY_INLINE Lanes3<V> rotate(const RotationOf<V>& r, const Lanes3<V>& v) {
  return (r.x * v.x + r.y * v.y) + r.z * v.z;
}

template <class V>
HWY_INLINE Lanes3<V> rotate_back(const RotationOf<V>& r, const Lanes3<V>& v) {
  return {dot(r.x, v), dot(r.y, v), dot(r.z, v)};
}

// The position of B relative to A in world axes (d), and both orientations.
template <class V>
struct PoseOf {
  Lanes3<V> d;
  QuaternionOf<V> a, b;
};
using PoseLanes = PoseOf<F>;

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_SIMD_ROTATION_INL_H_
