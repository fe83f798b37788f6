// Packs the lanes that a mask selects.
#if defined(CAROM_SIMD_COMPRESS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_SIMD_COMPRESS_INL_H_
#undef CAROM_SIMD_COMPRESS_INL_H_
#else
#define CAROM_SIMD_COMPRESS_INL_H_
#endif

#include <algorithm>
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

// Where lane k of `lanes` lanes must be, so that InterleaveLower and InterleaveUpper bring the
// lanes into order. They work within 128-bit blocks, so the first half fills the lower halves of
// all blocks.
constexpr size_t place_for_interleaving(size_t k, size_t lanes) {
  const size_t half = lanes / 2;
  return half < 2 ? k : k % half / 2 * 4 + k / half * 2 + k % 2;
}

template <size_t kCount>
struct alignas(64) InterleavingOrder {
  int32_t lane[kCount];

  constexpr InterleavingOrder() : lane() {
    for (size_t k = 0; k < kCount; ++k) {
      lane[place_for_interleaving(k, kCount)] = static_cast<int32_t>(k);
    }
  }
};

// Brings lanes into the order for interleaving.
template <class Tag, class V>
HWY_INLINE V order_for_interleaving(Tag tag, V v) {
  constexpr size_t kCount = kLanesOf<Tag>;
  if constexpr (kCount <= 4) {
    return v;
  } else {
    static constexpr InterleavingOrder<kCount> kOrder;
    return hn::TableLookupLanes(v, hn::SetTableIndices(tag, kOrder.lane));
  }
}

// Writes (a, b) of one lane after the other. The lanes are in the order for interleaving.
template <class Tag, class V>
HWY_INLINE void store_interleaved(Tag tag, V a, V b, uint32_t* to) {
#if HWY_TARGET == HWY_SCALAR
  hn::StoreInterleaved2(a, b, tag, to);
#else
  hn::StoreU(hn::InterleaveLower(tag, a, b), tag, to);
  hn::StoreU(hn::InterleaveUpper(tag, a, b), tag, to + kLanesOf<Tag>);
#endif
}

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
inline constexpr auto kForInterleaving =
    compress_table([](size_t k) { return place_for_interleaving(k, kLanes); });

template <class Table>
HWY_INLINE Indices permute(Indices v, const Table& table, size_t mask_bits) {
  const hn::RebindToSigned<IndexTag> index_tag;
  const hn::Rebind<uint8_t, IndexTag> byte_tag;
  const auto lanes = hn::PromoteTo(index_tag, hn::LoadU(byte_tag, table[mask_bits].data()));
  return hn::TableLookupLanes(v, hn::IndicesFromVec(IndexTag(), lanes));
}
#endif

// The lanes whose byte is 1.
HWY_INLINE Mask lanes_with_one(const uint8_t* bytes) {
  const IndexTag tag;
  const hn::Rebind<uint8_t, IndexTag> byte_tag;
  const Indices numbers = hn::PromoteTo(tag, hn::LoadU(byte_tag, bytes));
  return hn::RebindMask(FloatTag(), hn::Eq(numbers, hn::Set(tag, 1)));
}

// Writes the selected lanes to `to` and returns their number. May write a whole vector. Vectors of
// `tag` may be narrower than the widest where the ISA has an instruction for Compress. (Some
// processors take a hundred cycles to compress to memory.)
template <class Tag, class V, class M>
HWY_INLINE size_t compress_store(Tag tag, V v, M mask, uint32_t* to) {
  const size_t bits = bits_of(tag, mask);
#if CAROM_COMPRESS_BY_TABLE
  static_assert(kLanesOf<Tag> == kLanes);
  hn::StoreU(permute(v, kInOrder, bits), tag, to);
#else
  hn::StoreU(hn::Compress(v, mask), tag, to);
#endif
  return static_cast<size_t>(std::popcount(bits));
}

HWY_INLINE size_t compress_store(Indices v, Mask mask, uint32_t* to) {
  return compress_store(IndexTag(), v, hn::RebindMask(IndexTag(), mask), to);
}

// The first `count` bits, of as many as there are lanes here.
HWY_INLINE size_t first_bits(size_t count) {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
  return (size_t{1} << count) - 1;  // one instruction, with what follows
#else
  static constexpr uint8_t kFirst[] = {0, 1, 3, 7, 15};
  return kFirst[count];
#endif
}

// Writes a pair (smaller, larger) of `one` and each selected lane of the first `lanes` lanes of
// `others`, and returns the number of pairs. May write two whole vectors. `tag` as above.
template <class Tag, class V, class M>
HWY_INLINE size_t store_pairs(Tag tag, V one, V others, M mask, size_t lanes, uint32_t* to) {
  const size_t among = first_bits(std::min(lanes, kLanesOf<Tag>));
#if CAROM_COMPRESS_BY_TABLE
  static_assert(kLanesOf<Tag> == kLanes);
  const size_t bits = bits_of(FloatTag(), mask) & among;
  const V selected = permute(others, kForInterleaving, bits);
#else
  // The lanes beyond come last, and are not counted.
  const size_t bits = bits_of(hn::RebindToFloat<Tag>(), mask) & among;
  const V selected = order_for_interleaving(tag, hn::Compress(others, hn::RebindMask(tag, mask)));
#endif
  store_interleaved(tag, hn::Min(one, selected), hn::Max(one, selected), to);
  return static_cast<size_t>(std::popcount(bits));
}

// Writes high * 2^32 + low of each selected lane, and returns their number. May write a whole
// vector of each.
HWY_INLINE size_t store_keys(Indices high, Indices low, Mask mask, uint64_t* to) {
  const IndexTag tag;
#if CAROM_COMPRESS_BY_TABLE
  const size_t bits = bits_of(FloatTag(), mask);
  high = permute(high, kForInterleaving, bits);
  low = permute(low, kForInterleaving, bits);
  const auto count = static_cast<size_t>(std::popcount(bits));
#else
  const auto selected = hn::RebindMask(tag, mask);
  high = order_for_interleaving(tag, hn::Compress(high, selected));
  low = order_for_interleaving(tag, hn::Compress(low, selected));
  const size_t count = hn::CountTrue(FloatTag(), mask);
#endif
  static_assert(std::endian::native == std::endian::little);
  store_interleaved(tag, low, high, reinterpret_cast<uint32_t*>(to));
  return count;
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#undef CAROM_COMPRESS_BY_TABLE
#endif  // CAROM_SIMD_COMPRESS_INL_H_
