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

// Pairs whose numbers are their places.
struct AllPairs {
  const uint32_t* until;

  HWY_INLINE Indices number(size_t i) const {
    return hn::Iota(IndexTag(), static_cast<uint32_t>(i));
  }
  HWY_INLINE Indices limit(size_t i, Indices) const { return hn::LoadU(IndexTag(), until + i); }
  HWY_INLINE uint32_t number_of(size_t i) const { return static_cast<uint32_t>(i); }
};

struct ListedPairs {
  const uint32_t* numbers;
  const uint32_t* until;

  HWY_INLINE Indices number(size_t i) const { return hn::LoadU(IndexTag(), numbers + i); }
  HWY_INLINE Indices limit(size_t, Indices number) const {
    return hn::GatherIndex(IndexTag(), until, hn::BitCast(IntTag(), number));
  }
  HWY_INLINE uint32_t number_of(size_t i) const { return numbers[i]; }
};

template <class Numbers>
HWY_INLINE size_t find_due(const Pair* pairs, const Numbers& numbers, const uint32_t* travelled,
                           uint32_t ahead, size_t begin, size_t end, uint32_t* due) {
  const IndexTag tag;
  const IntTag integers;
  const Indices more = hn::Set(tag, ahead);
  size_t count = 0, i = begin;
  for (; i + kLanes <= end; i += kLanes) {
    Indices a, b;
    hn::LoadInterleaved2(tag, reinterpret_cast<const uint32_t*>(pairs + i), a, b);
    const auto odometers = [&](Indices bodies) HWY_ATTR {
      return hn::GatherIndex(tag, travelled, hn::BitCast(integers, bodies));
    };
    const Indices number = numbers.number(i);
    const Indices sum = hn::Add(hn::Add(odometers(a), odometers(b)), more);
    const Indices left = hn::Sub(numbers.limit(i, number), sum);
    const auto past = hn::Lt(hn::BitCast(integers, left), hn::Zero(integers));
    count += compress_store(number, hn::RebindMask(FloatTag(), past), due + count);
  }
  for (; i < end; ++i) {
    due[count] = numbers.number_of(i);
    const uint32_t sum = travelled[pairs[i].a] + travelled[pairs[i].b] + ahead;
    count += (numbers.until[due[count]] - sum) >> 31;
  }
  return count;
}

size_t find_due_of_all(const Pair* pairs, const uint32_t* until, const uint32_t* travelled,
                       uint32_t ahead, size_t begin, size_t end, uint32_t* due) {
  return find_due(pairs, AllPairs{until}, travelled, ahead, begin, end, due);
}

size_t find_due_of_listed(const Pair* pairs, const uint32_t* number, const uint32_t* until,
                          const uint32_t* travelled, size_t begin, size_t end, uint32_t* due) {
  return find_due(pairs, ListedPairs{number, until}, travelled, 0, begin, end, due);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(find_due_of_all);
HWY_EXPORT(find_due_of_listed);

}  // namespace

size_t find_due_pairs(const Pair* pairs, const uint32_t* until, const uint32_t* travelled,
                      uint32_t ahead, size_t begin, size_t end, uint32_t* due) {
  return CAROM_DISPATCH(find_due_of_all)(pairs, until, travelled, ahead, begin, end, due);
}

size_t find_due_of_list(const Pair* pairs, const uint32_t* number, const uint32_t* until,
                        const uint32_t* travelled, size_t begin, size_t end, uint32_t* due) {
  return CAROM_DISPATCH(find_due_of_listed)(pairs, number, until, travelled, begin, end, due);
}

}  // namespace carom
#endif  // HWY_ONCE
