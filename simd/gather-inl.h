// Loads records of four floats from any addresses into four vectors of lanes. Plain 16-byte loads
// and a transpose are about four times as fast as hardware gathers.
#if defined(CAROM_SIMD_GATHER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_SIMD_GATHER_INL_H_
#undef CAROM_SIMD_GATHER_INL_H_
#else
#define CAROM_SIMD_GATHER_INL_H_
#endif

#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// transpose_records() loads the records 0 ... kLanes - 1 of a source and writes their components as
// lanes. A source gives record i as
//   hn::Vec<Quad> quad(size_t i)         on ISAs with vectors
//   float component(size_t i, size_t c)  on the scalar one
#if HWY_TARGET != HWY_SCALAR

using Quad = hn::FixedTag<float, 4>;
using DoublePair = hn::FixedTag<double, 2>;

// A vector whose 128-bit block j is record k + 4 j.
template <class Tag, class Source>
HWY_INLINE hn::Vec<Tag> interleaved_row(Tag tag, const Source& source, size_t k) {
  if constexpr (hn::MaxLanes(Tag()) == 4) {
    return source.quad(k);
  } else {
    const hn::Half<Tag> half;
    return hn::Combine(tag, interleaved_row(half, source, k + hn::MaxLanes(half)),
                       interleaved_row(half, source, k));
  }
}

// Transposes every block of four by four. Lane i of xyz and w is of row i % 4.
HWY_INLINE void transpose_rows(F r0, F r1, F r2, F r3, F3& xyz, F& w) {
  const FloatTag tag;
  const F xy02 = hn::InterleaveLower(tag, r0, r2);
  const F xy13 = hn::InterleaveLower(tag, r1, r3);
  const F zw02 = hn::InterleaveUpper(tag, r0, r2);
  const F zw13 = hn::InterleaveUpper(tag, r1, r3);
  xyz.x = hn::InterleaveLower(tag, xy02, xy13);
  xyz.y = hn::InterleaveUpper(tag, xy02, xy13);
  xyz.z = hn::InterleaveLower(tag, zw02, zw13);
  w = hn::InterleaveUpper(tag, zw02, zw13);
}

template <class Source>
HWY_INLINE void transpose_records(const Source& source, F3& xyz, F& w) {
  const FloatTag tag;
  transpose_rows(interleaved_row(tag, source, 0), interleaved_row(tag, source, 1),
                 interleaved_row(tag, source, 2), interleaved_row(tag, source, 3), xyz, w);
}

// Four doubles, rounded to float32.
HWY_INLINE hn::Vec<Quad> demote_quad(hn::Vec<DoublePair> xy, hn::Vec<DoublePair> zw) {
  const hn::Half<Quad> half;
  return hn::Combine(Quad(), hn::DemoteTo(half, zw), hn::DemoteTo(half, xy));
}

#else

template <class Source>
HWY_INLINE void transpose_records(const Source& source, F3& xyz, F& w) {
  xyz = {splat(source.component(0, 0)), splat(source.component(0, 1)),
         splat(source.component(0, 2))};
  w = splat(source.component(0, 3));
}

#endif

// Lane i is at(i).
template <class At>
HWY_INLINE F lanes_from(const At& at) {
  HWY_ALIGN float values[kLanes];
  for (size_t i = 0; i < kLanes; ++i) values[i] = at(i);
  return hn::Load(FloatTag(), values);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_SIMD_GATHER_INL_H_
