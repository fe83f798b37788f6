#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "world/pairs/due_pairs.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "simd/compress-inl.h"
#include "world/pairs/due_pairs.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

static_assert(kDuePadding >= kLanes);

size_t find_due(const Pair* pairs, const uint32_t* until, const uint32_t* travelled, size_t begin,
                size_t end, uint32_t* due) {
  const IndexTag tag;
  const IntTag integers;
  size_t count = 0, i = begin;
  for (; i + kLanes <= end; i += kLanes) {
    Indices a, b;
    hn::LoadInterleaved2(tag, reinterpret_cast<const uint32_t*>(pairs + i), a, b);
    const auto odometers = [&](Indices bodies) HWY_ATTR {
      return hn::GatherIndex(tag, travelled, hn::BitCast(integers, bodies));
    };
    const Indices left = hn::Sub(hn::LoadU(tag, until + i), hn::Add(odometers(a), odometers(b)));
    const auto past = hn::Lt(hn::BitCast(integers, left), hn::Zero(integers));
    const Indices place = hn::Iota(tag, static_cast<uint32_t>(i));
    count += compress_store(place, hn::RebindMask(FloatTag(), past), due + count);
  }
  for (; i < end; ++i) {
    const uint32_t left = until[i] - (travelled[pairs[i].a] + travelled[pairs[i].b]);
    due[count] = static_cast<uint32_t>(i);
    count += left >> 31;
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

HWY_EXPORT(find_due);

}  // namespace

size_t find_due_pairs(const Pair* pairs, const uint32_t* until, const uint32_t* travelled,
                      size_t begin, size_t end, uint32_t* due) {
  return CAROM_DISPATCH(find_due)(pairs, until, travelled, begin, end, due);
}

}  // namespace carom
#endif  // HWY_ONCE
