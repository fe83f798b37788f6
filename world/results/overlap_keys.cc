// Packs the pairs that overlap, a vector at a time: which they are cannot be predicted.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "world/results/overlap_keys.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "simd/compress-inl.h"
#include "world/results/overlap_keys.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

size_t list_in_lanes(std::span<const Pair> pairs, const uint8_t* overlap, const uint32_t* contact,
                     uint64_t* keys, uint32_t* contacts) {
  static_assert(kLanes <= kOverlapsBeyond);
  const IndexTag tag;
  const hn::Rebind<uint8_t, IndexTag> bytes;
  size_t count = 0, i = 0;
  for (; i + kLanes <= pairs.size(); i += kLanes) {
    Indices a, b;
    hn::LoadInterleaved2(tag, &pairs[i].a, a, b);
    const Indices decision = hn::PromoteTo(tag, hn::LoadU(bytes, overlap + i));
    const Mask overlaps = hn::RebindMask(FloatTag(), hn::Eq(decision, hn::Set(tag, 1)));
    compress_store(hn::LoadU(tag, contact + i), overlaps, contacts + count);
    count += store_keys(a, b, overlaps, keys + count);
  }
  for (; i < pairs.size(); ++i) {
    keys[count] = pair_key(pairs[i]);
    contacts[count] = contact[i];
    count += overlap[i] == 1;
  }
  return count;
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(list_in_lanes);

}  // namespace

size_t list_overlaps(std::span<const Pair> pairs, const uint8_t* overlap, const uint32_t* contact,
                     uint64_t* keys, uint32_t* contacts) {
  return CAROM_DISPATCH(list_in_lanes)(pairs, overlap, contact, keys, contacts);
}

}  // namespace carom
#endif  // HWY_ONCE
