// Products of vectors in lanes, and rotations.
#if defined(CAROM_SIMD_ROTATION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_SIMD_ROTATION_INL_H_
#undef CAROM_SIMD_ROTATION_INL_H_
#else
#define CAROM_SIMD_ROTATION_INL_H_
#endif

#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

HWY_INLINE F dot(const F3& a, const F3& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

HWY_INLINE F3 cross(const F3& a, const F3& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)),
          hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}

HWY_INLINE F3 negate_if(Mask mask, const F3& v) { return select(mask, -v, v); }

HWY_INLINE F clamp(F v, F low, F high) { return min(max(v, low), high); }

// x, y, z, w; any length but zero.
struct Quaternion {
  F3 v;
  F w;
};

HWY_INLINE F squared_norm(const Quaternion& q) { return hn::Add(dot(q.v, q.v), hn::Mul(q.w, q.w)); }

// Columns: where the axes go.
struct Rotation {
  F3 x, y, z;
};

// M(q) / |q|^2.
HWY_INLINE Rotation rotation_of(const Quaternion& q) {
  const F one = splat(1);
  const F s = hn::Div(splat(2), squared_norm(q));
  const F3 scaled = q.v * s;
  const F xx = hn::Mul(q.v.x, scaled.x);
  const F xy = hn::Mul(q.v.x, scaled.y);
  const F xz = hn::Mul(q.v.x, scaled.z);
  const F yy = hn::Mul(q.v.y, scaled.y);
  const F yz = hn::Mul(q.v.y, scaled.z);
  const F zz = hn::Mul(q.v.z, scaled.z);
  const F wx = hn::Mul(q.w, scaled.x);
  const F wy = hn::Mul(q.w, scaled.y);
  const F wz = hn::Mul(q.w, scaled.z);
  return {{hn::Sub(one, hn::Add(yy, zz)), hn::Add(xy, wz), hn::Sub(xz, wy)},
          {hn::Sub(xy, wz), hn::Sub(one, hn::Add(xx, zz)), hn::Add(yz, wx)},
          {hn::Add(xz, wy), hn::Sub(yz, wx), hn::Sub(one, hn::Add(xx, yy))}};
}

// conj(a) * b: from the frame of b to that of a.
HWY_INLINE Quaternion relative_rotation(const Quaternion& a, const Quaternion& b) {
  return {(b.v * a.w - a.v * b.w) - cross(a.v, b.v), hn::Add(hn::Mul(a.w, b.w), dot(a.v, b.v))};
}

HWY_INLINE F3 rotate(const Rotation& r, const F3& v) { return (r.x * v.x + r.y * v.y) + r.z * v.z; }

HWY_INLINE F3 rotate_back(const Rotation& r, const F3& v) {
  return {dot(r.x, v), dot(r.y, v), dot(r.z, v)};
}

// Of bodies A and B: where B is, seen from A, in world axes, and how both are turned.
struct PoseLanes {
  F3 d;
  Quaternion a, b;
};

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_SIMD_ROTATION_INL_H_
