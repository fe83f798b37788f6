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

// A vector whose 128-bit block j holds components c and c + 1 of record i + 2 j.
template <class Tag, class Source>
HWY_INLINE hn::Vec<Tag> interleaved_pairs(Tag tag, const Source& source, size_t i, size_t c) {
  if constexpr (hn::MaxLanes(Tag()) == 2) {
    return hn::LoadU(tag, source.record(i) + c);
  } else {
    const hn::Half<Tag> half;
    return hn::Combine(tag, interleaved_pairs(half, source, i + hn::MaxLanes(half), c),
                       interleaved_pairs(half, source, i, c));
  }
}

// Loads records of doubles from `first` on, as many as a vector has, of a source that gives record
// i as
//   const double* record(size_t i)
template <class Source>
HWY_INLINE void transpose_doubles(const Source& source, size_t first, D3& xyz, D& w) {
  const DoubleTag tag;
  const D xy_even = interleaved_pairs(tag, source, first, 0);
  const D xy_odd = interleaved_pairs(tag, source, first + 1, 0);
  const D zw_even = interleaved_pairs(tag, source, first, 2);
  const D zw_odd = interleaved_pairs(tag, source, first + 1, 2);
  xyz.x = hn::InterleaveLower(tag, xy_even, xy_odd);
  xyz.y = hn::InterleaveUpper(tag, xy_even, xy_odd);
  xyz.z = hn::InterleaveLower(tag, zw_even, zw_odd);
  w = hn::InterleaveUpper(tag, zw_even, zw_odd);
}

#else

template <class Source>
HWY_INLINE void transpose_records(const Source& source, F3& xyz, F& w) {
  xyz = {splat(source.component(0, 0)), splat(source.component(0, 1)),
         splat(source.component(0, 2))};
  w = splat(source.component(0, 3));
}

template <class Source>
HWY_INLINE void transpose_doubles(const Source& source, size_t first, D3& xyz, D& w) {
  const double* const record = source.record(first);
  xyz = {splat_double(record[0]), splat_double(record[1]), splat_double(record[2])};
  w = splat_double(record[3]);
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
