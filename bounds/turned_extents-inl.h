// Extents of turned boxes and capsules, in lanes: bit for bit the results of extent_of(), in double
// precision as there.
#if defined(CAROM_BOUNDS_TURNED_EXTENTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_BOUNDS_TURNED_EXTENTS_INL_H_
#undef CAROM_BOUNDS_TURNED_EXTENTS_INL_H_
#else
#define CAROM_BOUNDS_TURNED_EXTENTS_INL_H_
#endif

#include "bounds/bounds_sums-inl.h"
#include "shapes/turn.h"
#include "simd/gather-inl.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

HWY_INLINE D3 absolute(const D3& v) { return {hn::Abs(v.x), hn::Abs(v.y), hn::Abs(v.z)}; }
HWY_INLINE D greatest(const D3& v) { return max(hn::Abs(v.z), max(hn::Abs(v.y), hn::Abs(v.x))); }

// The rows of M(q) / |q|^2, as rotation_of().
struct TurnLanes {
  D3 x, y, z;

  HWY_INLINE TurnLanes(const D3& v, D w) {
    const D one = splat_double(1);
    const D xx = hn::Mul(v.x, v.x), yy = hn::Mul(v.y, v.y), zz = hn::Mul(v.z, v.z);
    const D xy = hn::Mul(v.x, v.y), xz = hn::Mul(v.x, v.z), yz = hn::Mul(v.y, v.z);
    const D wx = hn::Mul(w, v.x), wy = hn::Mul(w, v.y), wz = hn::Mul(w, v.z);
    const D norm = hn::Add(hn::Add(xx, yy), hn::Add(zz, hn::Mul(w, w)));
    const D s = hn::Div(splat_double(2), norm);
    x = {hn::Sub(one, hn::Mul(s, hn::Add(yy, zz))), hn::Mul(s, hn::Sub(xy, wz)),
         hn::Mul(s, hn::Add(xz, wy))};
    y = {hn::Mul(s, hn::Add(xy, wz)), hn::Sub(one, hn::Mul(s, hn::Add(xx, zz))),
         hn::Mul(s, hn::Sub(yz, wx))};
    z = {hn::Mul(s, hn::Sub(xz, wy)), hn::Mul(s, hn::Add(yz, wx)),
         hn::Sub(one, hn::Mul(s, hn::Add(xx, yy)))};
  }
};

// How far a shape reaches along the world axes, before rounding.
struct Reach {
  D3 lower, upper;
};

HWY_INLINE void grow(D radius, D slack, Reach& reach) {
  reach.lower = {hn::Sub(hn::Sub(reach.lower.x, radius), slack),
                 hn::Sub(hn::Sub(reach.lower.y, radius), slack),
                 hn::Sub(hn::Sub(reach.lower.z, radius), slack)};
  reach.upper = {hn::Add(hn::Add(reach.upper.x, radius), slack),
                 hn::Add(hn::Add(reach.upper.y, radius), slack),
                 hn::Add(hn::Add(reach.upper.z, radius), slack)};
}

// Shapes as rows of four floats: `Rows` reads row k of the shape in each lane.
struct BoxReach {
  static constexpr ShapeKind kKind = ShapeKind::box;
  F3 half;
  F unused;

  template <class Rows>
  HWY_INLINE explicit BoxReach(const Rows& rows) {
    transpose_records(rows(0), half, unused);
  }

  HWY_INLINE Mask is_valid() const {
    const F least = min(half.x, min(half.y, half.z));
    const F sum = hn::Add(hn::Add(half.x, half.y), hn::Add(half.z, hn::Abs(unused)));
    return hn::And(hn::Ge(least, splat(0)), hn::Le(sum, splat(FLT_MAX)));
  }

  // `wide` makes doubles of the floats of some lanes.
  template <class Widen>
  HWY_INLINE void compute(const Widen& wide, const TurnLanes& turn, Reach& reach) const {
    const D3 h = {wide(half.x), wide(half.y), wide(half.z)};
    const D slack = hn::Mul(splat_double(kTurnRounding), max(greatest(h), wide(unused)));
    reach.upper = {dot(absolute(turn.x), h), dot(absolute(turn.y), h), dot(absolute(turn.z), h)};
    reach.lower = {hn::Neg(reach.upper.x), hn::Neg(reach.upper.y), hn::Neg(reach.upper.z)};
    grow(splat_double(0), slack, reach);
  }
};

struct CapsuleReach {
  static constexpr ShapeKind kKind = ShapeKind::capsule;
  F3 a, b;
  F radius, unused;

  template <class Rows>
  HWY_INLINE explicit CapsuleReach(const Rows& rows) {
    transpose_records(rows(0), a, radius);
    transpose_records(rows(1), b, unused);
  }

  HWY_INLINE Mask is_valid() const {
    const auto sum = [](const F3& v) HWY_ATTR {
      return hn::Add(hn::Add(hn::Abs(v.x), hn::Abs(v.y)), hn::Abs(v.z));
    };
    const F all = hn::Add(hn::Add(sum(a), sum(b)), hn::Add(radius, hn::Abs(unused)));
    return hn::And(hn::Ge(radius, splat(0)), hn::Le(all, splat(FLT_MAX)));
  }

  template <class Widen>
  HWY_INLINE void compute(const Widen& wide, const TurnLanes& turn, Reach& reach) const {
    const D3 p = {wide(a.x), wide(a.y), wide(a.z)}, q = {wide(b.x), wide(b.y), wide(b.z)};
    const D r = wide(radius);
    const D slack = hn::Mul(splat_double(kTurnRounding), max(greatest(q), max(greatest(p), r)));
    const D3 from = {dot(turn.x, p), dot(turn.y, p), dot(turn.z, p)};
    const D3 to = {dot(turn.x, q), dot(turn.y, q), dot(turn.z, q)};
    reach.lower = {min(to.x, from.x), min(to.y, from.y), min(to.z, from.z)};
    reach.upper = {max(to.x, from.x), max(to.y, from.y), max(to.z, from.z)};
    grow(r, slack, reach);
  }
};

// Floats rounded downwards; clamped to those that are finite.
HWY_INLINE F downwards(const Wide& v) {
  F rounded, error;
  narrow_finite(v, rounded, error);
  return neighbour<-1>(rounded, hn::Lt(error, splat(0)));
}

// Whether q is surely a rotation. The others are read one at a time.
HWY_INLINE Mask is_plain(const Quaternion& q) {
  const F norm = hn::Add(dot(q.v, q.v), hn::Mul(q.w, q.w));
  return hn::And(hn::Gt(norm, splat(0)), hn::Le(norm, splat(FLT_MAX)));
}

// The extents of turned shapes. Returns false if a lane may not be valid; the extents are then not
// written.
template <class Shape>
HWY_INLINE bool turned_extents(const Shape& shape, const Quaternion& q, F3& lower, F3& upper) {
  const Mask plain = hn::And(is_plain(q), shape.is_valid());
  if (HWY_UNLIKELY(!hn::AllTrue(FloatTag(), plain))) return false;
  Wide low[3], high[3];  // the negative of the upper ends
  for_each_half([&](const auto& wide, const auto& half_of) HWY_ATTR {
    const TurnLanes turn({wide(q.v.x), wide(q.v.y), wide(q.v.z)}, wide(q.w));
    Reach reach;
    shape.compute(wide, turn, reach);
    half_of(low[0]) = reach.lower.x;
    half_of(low[1]) = reach.lower.y;
    half_of(low[2]) = reach.lower.z;
    half_of(high[0]) = hn::Neg(reach.upper.x);
    half_of(high[1]) = hn::Neg(reach.upper.y);
    half_of(high[2]) = hn::Neg(reach.upper.z);
  });
  lower = {downwards(low[0]), downwards(low[1]), downwards(low[2])};
  upper = {hn::Neg(downwards(high[0])), hn::Neg(downwards(high[1])), hn::Neg(downwards(high[2]))};
  return true;
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_BOUNDS_TURNED_EXTENTS_INL_H_
