// The lane types that kernels are written in, and the arithmetic that must give the same bits on
// every ISA. No fused multiply-add, no approximate reciprocals.
#if defined(CAROM_SIMD_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_SIMD_LANES_INL_H_
#undef CAROM_SIMD_LANES_INL_H_
#else
#define CAROM_SIMD_LANES_INL_H_
#endif

#include <cfloat>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// As many float lanes as the ISA has: 4, 8 or 16; one on the scalar target.
using FloatTag = hn::ScalableTag<float>;
using IntTag = hn::RebindToSigned<FloatTag>;
using F = hn::Vec<FloatTag>;
using I = hn::Vec<IntTag>;
using Mask = hn::Mask<FloatTag>;
inline constexpr size_t kLanes = HWY_LANES(float);
template <class Tag>
inline constexpr size_t kLanesOf = hn::MaxLanes(Tag());

HWY_INLINE Mask no_lanes() { return hn::MaskFromVec(hn::Zero(FloatTag())); }
HWY_INLINE F splat(float value) { return hn::Set(FloatTag(), value); }

// As many double lanes as the ISA has: half as many as floats, one on the scalar target.
using DoubleTag = hn::ScalableTag<double>;
using D = hn::Vec<DoubleTag>;
using DoubleMask = hn::Mask<DoubleTag>;
inline constexpr size_t kDoubleLanes = HWY_LANES(double);

HWY_INLINE D splat_double(double value) { return hn::Set(DoubleTag(), value); }

// For code that runs in lanes of floats or of doubles.
template <class V>
using MaskOf = hn::Mask<hn::DFromV<V>>;
template <class V>
HWY_INLINE V splat_as(hn::TFromV<V> value) {
  return hn::Set(hn::DFromV<V>(), value);
}
template <class V>
HWY_INLINE MaskOf<V> no_lanes_of() {
  return hn::MaskFromVec(hn::Zero(hn::DFromV<V>()));
}

// a < b ? a : b and a > b ? a : b, to the bit: the second operand if the two are equal (+0 and -0).
// Highway's own Min and Max do that on x86 only.
template <class V>
HWY_INLINE V min(V a, V b) {
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR
  return hn::Min(a, b);
#else
  return hn::IfThenElse(hn::Lt(a, b), a, b);
#endif
}

template <class V>
HWY_INLINE V max(V a, V b) {
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR
  return hn::Max(a, b);
#else
  return hn::IfThenElse(hn::Gt(a, b), a, b);
#endif
}

// Bit k is lane k of the mask, of up to sixteen lanes. Bits beyond the lanes are zero.
template <class Tag, class AnyMask>
HWY_INLINE uint64_t bits_of(Tag tag, AnyMask mask) {
  uint8_t bits[8] = {};
  hn::StoreMaskBits(tag, mask, bits);
  if constexpr (kLanesOf<Tag> <= 8) return bits[0];
  uint16_t both;  // in one piece: g++ would take it apart
  std::memcpy(&both, bits, sizeof(both));
  return both;
}

HWY_INLINE F clamp_to_finite(F v) { return min(max(v, splat(-FLT_MAX)), splat(FLT_MAX)); }

// g++ 12 copies structs of vectors through memory in pieces, and stalls on it. So pass them by
// reference and return them, but do not make them members of other results.
template <class V>
struct Lanes3 {
  V x, y, z;
};
using F3 = Lanes3<F>;
using D3 = Lanes3<D>;

HWY_INLINE F3 splat3(float value) { return {splat(value), splat(value), splat(value)}; }

template <class V>
HWY_INLINE Lanes3<V> operator+(const Lanes3<V>& a, const Lanes3<V>& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
template <class V>
HWY_INLINE Lanes3<V> operator-(const Lanes3<V>& a, const Lanes3<V>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
template <class V>
HWY_INLINE Lanes3<V> operator*(const Lanes3<V>& a, V s) {
  return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
}
template <class V>
HWY_INLINE Lanes3<V> operator-(const Lanes3<V>& a) {
  return {hn::Neg(a.x), hn::Neg(a.y), hn::Neg(a.z)};
}
template <class V>
HWY_INLINE Lanes3<V> min(const Lanes3<V>& a, const Lanes3<V>& b) {
  return {min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)};
}
template <class V>
HWY_INLINE Lanes3<V> max(const Lanes3<V>& a, const Lanes3<V>& b) {
  return {max(a.x, b.x), max(a.y, b.y), max(a.z, b.z)};
}
HWY_INLINE F3 clamp_to_finite(const F3& v) {
  return {clamp_to_finite(v.x), clamp_to_finite(v.y), clamp_to_finite(v.z)};
}
template <class M, class V>
HWY_INLINE Lanes3<V> select(M mask, const Lanes3<V>& yes, const Lanes3<V>& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
          hn::IfThenElse(mask, yes.z, no.z)};
}
template <class M, class V>
HWY_INLINE Lanes3<V> zero_unless(M mask, const Lanes3<V>& v) {
  return {hn::IfThenElseZero(mask, v.x), hn::IfThenElseZero(mask, v.y),
          hn::IfThenElseZero(mask, v.z)};
}

template <class V>
HWY_INLINE V largest_component(const Lanes3<V>& v) {
  return max(max(hn::Abs(v.x), hn::Abs(v.y)), hn::Abs(v.z));
}

// up = 2^k and down = 2^-k, where 2^k is the power of two in `magnitude`, clamped so that both are
// normal floats.
HWY_INLINE void power_of_two(F magnitude, F& up, F& down) {
  const FloatTag tag;
  const IntTag bits;
  I exponent = hn::And(hn::BitCast(bits, magnitude), hn::Set(bits, 0x7f800000));
  exponent = hn::Min(hn::Max(exponent, hn::Set(bits, 0x00800000)), hn::Set(bits, 0x7e800000));
  up = hn::BitCast(tag, exponent);
  down = hn::BitCast(tag, hn::Sub(hn::Set(bits, 0x7f000000), exponent));
}

// The same in doubles, as scalar::scale_of(), but for zero. The powers lie between 2^-1000 and
// 2^1000.
HWY_INLINE void power_of_two(D magnitude, D& up, D& down) {
  const DoubleTag tag;
  const hn::RebindToSigned<DoubleTag> bits;
  constexpr int64_t kOne = int64_t{1} << 52;  // of the exponent
  const auto exponent = hn::And(hn::BitCast(bits, magnitude), hn::Set(bits, 0x7ff * kOne));
  up = min(max(hn::BitCast(tag, exponent), splat_double(0x1p-1000)), splat_double(0x1p1000));
  down = hn::BitCast(tag, hn::Sub(hn::Set(bits, 2 * 0x3ff * kOne), hn::BitCast(bits, up)));
}

// The length of a vector and its unit direction. `is_zero`: the vector is exactly zero, and the
// direction is NaN.
struct Length {
  F length;
  F3 direction;
  Mask is_zero;
};

// Scales by a power of two first (exact), so that squares neither overflow nor vanish: correct for
// every finite vector. Lengths beyond the largest float are clamped to it.
HWY_INLINE Length measure(const F3& v) {
  F up, down;
  power_of_two(largest_component(v), up, down);
  const F3 s = v * down;
  const F square = hn::Add(hn::Add(hn::Mul(s.x, s.x), hn::Mul(s.y, s.y)), hn::Mul(s.z, s.z));
  const F length = hn::Sqrt(square);
  return {.length = min(hn::Mul(length, up), splat(FLT_MAX)),
          .direction = s * hn::Div(splat(1), length),
          .is_zero = hn::Eq(length, splat(0))};
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_SIMD_LANES_INL_H_
