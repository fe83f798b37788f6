// Reduces many contact points to at most four, in lanes.
#if defined(CAROM_NARROWPHASE_MANIFOLDS_REDUCE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_MANIFOLDS_REDUCE_INL_H_
#undef CAROM_NARROWPHASE_MANIFOLDS_REDUCE_INL_H_
#else
#define CAROM_NARROWPHASE_MANIFOLDS_REDUCE_INL_H_
#endif

#include "narrowphase/manifolds/clip-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

template <size_t kCount>
HWY_INLINE void move_where(Mask mask, const ClipPoints<kCount>& from, size_t i, ClipPoints<4>& to,
                           size_t k) {
  to.x[k] = hn::IfThenElse(mask, from.x[i], to.x[k]);
  to.y[k] = hn::IfThenElse(mask, from.y[i], to.y[k]);
  to.s[k] = hn::IfThenElse(mask, from.s[i], to.s[k]);
}

template <size_t kCount>
HWY_INLINE void put_deepest(const ClipPoints<kCount>& all, ClipPoints<4>& few) {
  few.x[0] = all.x[0];
  few.y[0] = all.y[0];
  few.s[0] = all.s[0];
  for (size_t i = 1; i < kCount; ++i) move_where(hn::Lt(all.s[i], few.s[0]), all, i, few, 0);
}

// Returns the squared distance from the first point to the second. Unused places fail every
// comparison.
template <size_t kCount>
HWY_INLINE F put_farthest(const ClipPoints<kCount>& all, ClipPoints<4>& few) {
  const F x = few.x[0];
  const F y = few.y[0];
  few.x[1] = x;
  few.y[1] = y;
  few.s[1] = few.s[0];
  F farthest = splat(0);
  for (size_t i = 0; i < kCount; ++i) {
    const F dx = hn::Sub(all.x[i], x);
    const F dy = hn::Sub(all.y[i], y);
    const F squared = hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy));
    move_where(hn::Gt(squared, farthest), all, i, few, 1);
    farthest = max(squared, farthest);
  }
  return farthest;
}

// On each side of the line through the first two points, the point farthest from it. `most` and
// `least` are twice the signed areas that the two span with the line.
template <size_t kCount>
HWY_INLINE void put_sides(const ClipPoints<kCount>& all, ClipPoints<4>& few, F& most, F& least) {
  const F x = few.x[0];
  const F y = few.y[0];
  const F dx = hn::Sub(few.x[1], x);
  const F dy = hn::Sub(few.y[1], y);
  for (size_t k = 2; k < 4; ++k) {
    few.x[k] = x;
    few.y[k] = y;
    few.s[k] = few.s[0];
  }
  most = least = splat(0);
  for (size_t i = 0; i < kCount; ++i) {
    const F area = area_left(dx, dy, hn::Sub(all.x[i], x), hn::Sub(all.y[i], y));
    move_where(hn::Gt(area, most), all, i, few, 2);
    move_where(hn::Lt(area, least), all, i, few, 3);
    most = max(area, most);
    least = min(area, least);
  }
}

// Up to four points: the deepest, the point farthest from it, and on each side of the line through
// both the point farthest from that line. `limit`: the squared distance below which points count as
// one. The used places come first; if the first is unused, all are.
template <size_t kCount>
HWY_INLINE void reduce(const ClipPoints<kCount>& all, F limit, ClipPoints<4>& few,
                       Mask (&used)[4]) {
  F most, least;
  put_deepest(all, few);
  const F farthest = put_farthest(all, few);
  put_sides(all, few, most, least);
  const F flat = hn::Mul(limit, farthest);
  used[0] = is_point(few.s[0]);
  used[1] = hn::And(used[0], hn::Gt(farthest, limit));
  const Mask has_left = hn::And(used[1], hn::Gt(hn::Mul(most, most), flat));
  const Mask has_right = hn::And(used[1], hn::Gt(hn::Mul(least, least), flat));
  move_where(hn::Not(has_left), few, 3, few, 2);
  used[2] = hn::Or(has_left, has_right);
  used[3] = hn::And(has_left, has_right);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_MANIFOLDS_REDUCE_INL_H_
