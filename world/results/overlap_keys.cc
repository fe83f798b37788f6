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
                     EventKind kind, uint64_t* keys, uint64_t* tails) {
  static_assert(kLanes <= kOverlapsBeyond);
  const IndexTag tag;
  // See event_tail().
  const Indices sensor = hn::Set(tag, PairHistory::kSensor), none = hn::Set(tag, kNoContact);
  const Indices kind_of_all = hn::Set(tag, static_cast<uint32_t>(kind));
  const Indices none_of_ends = kind == EventKind::end ? none : hn::Zero(tag);
  const Indices mark = hn::Set(tag, static_cast<uint32_t>(kSensorInTail >> 32));
  size_t count = 0, i = 0;
  for (; i + kLanes <= pairs.size(); i += kLanes) {
    Indices a, b;
    hn::LoadInterleaved2(tag, &pairs[i].a, a, b);
    const Mask overlaps = lanes_with_one(overlap + i);
    const Indices place = hn::LoadU(tag, contact + i);
    const auto is_sensor = hn::Eq(place, sensor);
    const Indices listed = hn::Or(hn::IfThenElse(is_sensor, none, place), none_of_ends);
    const Indices marks = hn::Or(kind_of_all, hn::IfThenElseZero(is_sensor, mark));
    store_keys(marks, listed, overlaps, tails + count);
    count += store_keys(a, b, overlaps, keys + count);
  }
  for (; i < pairs.size(); ++i) {
    keys[count] = pair_key(pairs[i]);
    tails[count] = event_tail(contact[i], kind);
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
                     EventKind kind, uint64_t* keys, uint64_t* tails) {
  return CAROM_DISPATCH(list_in_lanes)(pairs, overlap, contact, kind, keys, tails);
}

}  // namespace carom
#endif  // HWY_ONCE
