#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/batch/pack_rows.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/pack_rows.h"
#include "simd/compress-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

static_assert(sizeof(Pair) == sizeof(uint64_t));

HWY_INLINE Indices load_bits(const float* numbers) {
  return hn::BitCast(IndexTag(), hn::LoadU(FloatTag(), numbers));
}

size_t pack(const uint8_t* wanted, size_t count, const PackedPairs& pairs,
            std::span<const PackedColumn> columns) {
  const IndexTag tag;
  const hn::Rebind<uint16_t, IndexTag> shorts;
  size_t packed = 0, row = 0;
  for (; row + kLanes <= count; row += kLanes) {
    const Mask is_wanted = lanes_with_one(wanted + row);
    for (const PackedColumn& column : columns) {
      compress_store(load_bits(column.from + row), is_wanted,
                     reinterpret_cast<uint32_t*>(column.to + packed));
    }
    HWY_ALIGN uint32_t numbers[kLanes];
    compress_store(hn::Iota(tag, static_cast<uint32_t>(row)), is_wanted, numbers);
    const hn::RebindToSigned<IndexTag> signed_tag;
    hn::StoreU(hn::DemoteTo(shorts, hn::BitCast(signed_tag, hn::Load(tag, numbers))), shorts,
               pairs.row_numbers + packed);
    Indices a, b;
    hn::LoadInterleaved2(tag, &pairs.from[row].a, a, b);
    // In memory a pair is the number b * 2^32 + a.
    packed += store_keys(b, a, is_wanted, reinterpret_cast<uint64_t*>(pairs.to + packed));
  }
  for (; row < count; ++row) {
    for (const PackedColumn& column : columns) column.to[packed] = column.from[row];
    pairs.to[packed] = pairs.from[row];
    pairs.row_numbers[packed] = static_cast<uint16_t>(row);
    packed += wanted[row] == 1;
  }
  return packed;
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(pack);

}  // namespace

size_t pack_rows(const uint8_t* wanted, size_t count, const PackedPairs& pairs,
                 std::span<const PackedColumn> columns) {
  return CAROM_DISPATCH(pack)(wanted, count, pairs, columns);
}

}  // namespace carom
#endif  // HWY_ONCE
