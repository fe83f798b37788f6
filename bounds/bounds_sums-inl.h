// Sums of position and extent rounded outwards, in lanes: bit for bit the results of
// base/outward.h. Positions are float32 or float64, everything else is float32.
#if defined(CAROM_BOUNDS_BOUNDS_SUMS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_BOUNDS_BOUNDS_SUMS_INL_H_
#undef CAROM_BOUNDS_BOUNDS_SUMS_INL_H_
#else
#define CAROM_BOUNDS_BOUNDS_SUMS_INL_H_
#endif

#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// As many doubles as a vector has floats. They take two vectors, except on the scalar target, where
// a vector is one number.
#if HWY_TARGET == HWY_SCALAR

using HalfTag = FloatTag;
using Half = hn::Vec<HalfTag>;
struct Wide {
  D all;
};

HWY_INLINE Wide load_wide(const double* from) { return {hn::LoadU(DoubleTag(), from)}; }
HWY_INLINE void store_wide(const Wide& v, double* to) { hn::StoreU(v.all, DoubleTag(), to); }
// A cast instead of Highway's DemoteTo, which saturates on this target only.
HWY_INLINE Half demote(D v) { return splat(static_cast<float>(hn::GetLane(v))); }
HWY_INLINE F demote(const Wide& v) { return demote(v.all); }

// Calls visit(wide, half_of) for the parts of a vector of floats of which a vector of doubles can
// be made: wide(F) makes it, half_of(Wide&) is where it lies.
template <class Visit>
HWY_INLINE void for_each_half(const Visit& visit) {
  visit([](F v) HWY_ATTR { return hn::PromoteTo(DoubleTag(), v); },
        [](Wide& v) HWY_ATTR -> D& { return v.all; });
}

#else

using HalfTag = hn::Half<FloatTag>;
using Half = hn::Vec<HalfTag>;
struct Wide {
  D low, high;
};

HWY_INLINE Wide load_wide(const double* from) {
  return {hn::LoadU(DoubleTag(), from), hn::LoadU(DoubleTag(), from + kLanes / 2)};
}
HWY_INLINE void store_wide(const Wide& v, double* to) {
  hn::StoreU(v.low, DoubleTag(), to);
  hn::StoreU(v.high, DoubleTag(), to + kLanes / 2);
}
// Rounds to the nearest float, and to infinity beyond their range.
HWY_INLINE Half demote(D v) { return hn::DemoteTo(HalfTag(), v); }
HWY_INLINE F demote(const Wide& v) {
  return hn::Combine(FloatTag(), demote(v.high), demote(v.low));
}

template <class Visit>
HWY_INLINE void for_each_half(const Visit& visit) {
  visit([](F v) HWY_ATTR { return hn::PromoteTo(DoubleTag(), hn::LowerHalf(HalfTag(), v)); },
        [](Wide& v) HWY_ATTR -> D& { return v.low; });
  visit([](F v) HWY_ATTR { return hn::PromoteTo(DoubleTag(), hn::UpperHalf(HalfTag(), v)); },
        [](Wide& v) HWY_ATTR -> D& { return v.high; });
}

#endif

struct Wide3 {
  Wide x, y, z;
};

// Where `steps` is set: the neighbouring float towards -inf (kTowards = -1) or +inf (+1), computed
// on its bits. There v must not be NaN or the infinity on that side, and a zero must have the sign
// of that side.
template <int kTowards>
HWY_INLINE F neighbour(F v, Mask steps) {
  const FloatTag tag;
  const IntTag bits;
  const I as_integer = hn::BitCast(bits, v);
  const I sign = hn::ShiftRight<31>(as_integer);  // 0 or -1
  // Positive floats order like their bits, negative ones in reverse.
  const I down = hn::Sub(hn::Xor(hn::BitCast(bits, hn::VecFromMask(tag, steps)), sign), sign);
  return hn::BitCast(tag, kTowards < 0 ? hn::Add(as_integer, down) : hn::Sub(as_integer, down));
}

template <class V>
HWY_INLINE void two_sum(V a, V b, V& sum, V& error) {  // the error is NaN if the sum overflows
  sum = hn::Add(a, b);
  const V b_part = hn::Sub(sum, a);
  error = hn::Add(hn::Sub(a, hn::Sub(sum, b_part)), hn::Sub(b, b_part));
}

// neighbour() never gets a zero here: a sum with an error is not zero, since sums near zero are
// exact.
HWY_INLINE F sum_downwards(F a, F b) {
  F sum, error;
  two_sum(a, b, sum, error);
  return min(neighbour<-1>(sum, hn::Lt(error, splat(0))), splat(FLT_MAX));
}

HWY_INLINE F sum_upwards(F a, F b) {
  F sum, error;
  two_sum(a, b, sum, error);
  return max(neighbour<1>(sum, hn::Gt(error, splat(0))), splat(-FLT_MAX));
}

// A float with the sign of v. The factor keeps it from underflowing; it may be infinite.
HWY_INLINE Half demote_sign(D v) { return demote(hn::Mul(v, hn::Set(DoubleTag(), 0x1p1000))); }

// The nearest float of a number that is not NaN, clamped to the finite ones, and a number with the
// sign of the rounding error.
HWY_INLINE void narrow_finite(D v, Half& rounded, Half& error) {
  const D clamped = min(max(v, splat_double(-double{FLT_MAX})), splat_double(FLT_MAX));
  rounded = demote(clamped);
  error = demote_sign(hn::Sub(clamped, hn::PromoteTo(DoubleTag(), rounded)));
}
HWY_INLINE void narrow_finite(const Wide& v, F& rounded, F& error) {
#if HWY_TARGET == HWY_SCALAR
  narrow_finite(v.all, rounded, error);
#else
  Half low, high, low_error, high_error;
  narrow_finite(v.low, low, low_error);
  narrow_finite(v.high, high, high_error);
  rounded = hn::Combine(FloatTag(), high, low);
  error = hn::Combine(FloatTag(), high_error, low_error);
#endif
}

// `sum`: the float nearest to the float64 sum. `error`: a number with the sign of (float64 sum -
// that float). Finite a + b does not overflow in float64.
HWY_INLINE void narrowed_sum(D a, Half b, Half& sum, Half& error) {
  const DoubleTag tag;
  const D wide = hn::Add(a, hn::PromoteTo(tag, b));
  sum = demote(wide);
  error = demote_sign(hn::Sub(wide, hn::PromoteTo(tag, sum)));
}

// A number with the sign of (exact sum - float64 sum).
HWY_INLINE Half wide_error(D a, Half b) {
  D sum, error;
  two_sum(a, hn::PromoteTo(DoubleTag(), b), sum, error);
  return demote_sign(error);
}

// The same for whole vectors, with the sign of the error against the exact sum. The error of the
// float64 sum is much smaller, so it decides only where the float64 sum is a float; data either
// hardly ever have such sums or nearly always.
HWY_INLINE void narrowed_sum(const Wide& a, F b, F& sum, F& error) {
#if HWY_TARGET == HWY_SCALAR
  narrowed_sum(a.all, b, sum, error);
  if (hn::GetLane(error) == 0) error = wide_error(a.all, b);
#else
  const FloatTag tag;
  const HalfTag half;
  const Half low_b = hn::LowerHalf(half, b);
  const Half high_b = hn::UpperHalf(half, b);
  Half low, high, low_error, high_error;
  narrowed_sum(a.low, low_b, low, low_error);
  narrowed_sum(a.high, high_b, high, high_error);
  sum = hn::Combine(tag, high, low);
  error = hn::Combine(tag, high_error, low_error);
  const Mask is_float = hn::Eq(error, splat(0));
  if (hn::AllFalse(tag, is_float)) return;
  const F wide = hn::Combine(tag, wide_error(a.high, high_b), wide_error(a.low, low_b));
  error = hn::IfThenElse(is_float, wide, error);
#endif
}

HWY_INLINE F sum_downwards(const Wide& a, F b) {
  F sum, error;
  narrowed_sum(a, b, sum, error);
  return neighbour<-1>(sum, hn::Lt(error, splat(0)));
}

HWY_INLINE F sum_upwards(const Wide& a, F b) {
  F sum, error;
  narrowed_sum(a, b, sum, error);
  return neighbour<1>(sum, hn::Gt(error, splat(0)));
}

// For boxes in world coordinates: nothing is rounded. (-0 becomes +0, as in any sum with zero.)
struct Origin {};
HWY_INLINE F sum_downwards(Origin, F b) { return hn::Add(splat(0), b); }
HWY_INLINE F sum_upwards(Origin, F b) { return hn::Add(splat(0), b); }

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_BOUNDS_BOUNDS_SUMS_INL_H_
