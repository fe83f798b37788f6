// Packs the lanes that a mask selects.
#if defined(CAROM_SIMD_COMPRESS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_SIMD_COMPRESS_INL_H_
#undef CAROM_SIMD_COMPRESS_INL_H_
#else
#define CAROM_SIMD_COMPRESS_INL_H_
#endif

#include <array>
#include <bit>

#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

using IndexTag = hn::RebindToUnsigned<FloatTag>;
using Indices = hn::Vec<IndexTag>;

// AVX-512 has an instruction for Compress, and the scalar target has one lane. On all other targets
// g++ 12 copies Highway's table of 1 KiB to the stack on every call, so a table of our own is
// faster.
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_AVX3
#define CAROM_COMPRESS_BY_TABLE 0
#else
#define CAROM_COMPRESS_BY_TABLE 1
#endif

#if CAROM_COMPRESS_BY_TABLE

// One entry for every mask: byte place(k) is the number of the k-th selected lane; the other bytes
// are 0.
template <class Place>
constexpr auto compress_table(const Place& place) {
  std::array<std::array<uint8_t, kLanes>, size_t{1} << kLanes> table{};
  for (size_t mask = 0; mask < table.size(); ++mask) {
    size_t count = 0;
    for (size_t lane = 0; lane < kLanes; ++lane) {
      if (mask >> lane & 1) table[mask][place(count++)] = static_cast<uint8_t>(lane);
    }
  }
  return table;
}

inline constexpr auto kInOrder = compress_table([](size_t k) { return k; });

// The order that InterleaveLower and InterleaveUpper turn into 0, 1, 2, ... They work within
// 128-bit blocks, so the first half of the selected lanes fills the lower halves of all blocks.
inline constexpr auto kForInterleaving = compress_table([](size_t k) {
  constexpr size_t kHalf = kLanes / 2;
  return k % kHalf / 2 * 4 + k / kHalf * 2 + k % 2;
});

template <class Table>
HWY_INLINE Indices permute(Indices v, const Table& table, size_t mask_bits) {
  const hn::RebindToSigned<IndexTag> index_tag;
  const hn::Rebind<uint8_t, IndexTag> byte_tag;
  const auto lanes = hn::PromoteTo(index_tag, hn::LoadU(byte_tag, table[mask_bits].data()));
  return hn::TableLookupLanes(v, hn::IndicesFromVec(IndexTag(), lanes));
}

HWY_INLINE size_t bits_of(Mask mask) {
  uint8_t bits[8] = {};
  hn::StoreMaskBits(FloatTag(), mask, bits);
  return bits[0];
}

#endif

// Writes the selected lanes to `to` and returns their number. May write a whole vector.
HWY_INLINE size_t compress_store(Indices v, Mask mask, uint32_t* to) {
  const IndexTag tag;
#if CAROM_COMPRESS_BY_TABLE
  const size_t bits = bits_of(mask);
  hn::StoreU(permute(v, kInOrder, bits), tag, to);
  return static_cast<size_t>(std::popcount(bits));
#else
  return hn::CompressStore(v, hn::RebindMask(tag, mask), tag, to);
#endif
}

// Writes a pair (smaller, larger) of `one` and each selected lane of `others`, and returns the
// number of pairs. May write two whole vectors.
HWY_INLINE size_t store_pairs(Indices one, Indices others, Mask mask, uint32_t* to) {
  const IndexTag tag;
#if CAROM_COMPRESS_BY_TABLE
  const size_t bits = bits_of(mask);
  const Indices selected = permute(others, kForInterleaving, bits);
  const Indices a = hn::Min(one, selected);
  const Indices b = hn::Max(one, selected);
  hn::StoreU(hn::InterleaveLower(tag, a, b), tag, to);
  hn::StoreU(hn::InterleaveUpper(tag, a, b), tag, to + kLanes);
  return static_cast<size_t>(std::popcount(bits));
#else
  const Indices selected = hn::Compress(others, hn::RebindMask(tag, mask));
  hn::StoreInterleaved2(hn::Min(one, selected), hn::Max(one, selected), tag, to);
  return hn::CountTrue(FloatTag(), mask);
#endif
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#undef CAROM_COMPRESS_BY_TABLE
#endif  // CAROM_SIMD_COMPRESS_INL_H_
