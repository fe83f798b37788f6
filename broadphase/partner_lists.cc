#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "broadphase/partner_lists.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <algorithm>
#include <array>

#include "broadphase/partner_lists.h"
#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

using PartnerTag = hn::RebindToUnsigned<FloatTag>;
using Partners = hn::Vec<PartnerTag>;

// One step of a sorting network: every lane is compared with another one.
struct NetworkStep {
  HWY_ALIGN std::array<int32_t, kLanes> other{};
  HWY_ALIGN std::array<uint32_t, kLanes> is_lower{};  // all bits set where the lane keeps the less
};

constexpr size_t step_count() {
  size_t steps = 0;
  for (size_t size = 2, merges = 1; size <= kLanes; size *= 2) steps += merges++;
  return steps;
}

// Batcher's bitonic network, with flips instead of descending halves ("Sorting networks and their
// applications", 1968).
constexpr auto make_network() {
  std::array<NetworkStep, step_count()> network{};
  size_t step = 0;
  for (size_t size = 2; size <= kLanes; size *= 2) {
    for (size_t flip = size - 1; flip > 0; flip = flip == size - 1 ? size / 4 : flip / 2, ++step) {
      for (size_t lane = 0; lane < kLanes; ++lane) {
        network[step].other[lane] = static_cast<int32_t>(lane ^ flip);
        network[step].is_lower[lane] = lane < (lane ^ flip) ? 0xffffffffu : 0;
      }
    }
  }
  return network;
}

HWY_INLINE Partners sort_lanes(Partners v) {
  if constexpr (kLanes > 1) {
    static constexpr auto kNetwork = make_network();
    const PartnerTag tag;
    for (const NetworkStep& step : kNetwork) {
      const Partners other = hn::TableLookupLanes(v, hn::SetTableIndices(tag, step.other.data()));
      const auto is_lower = hn::MaskFromVec(hn::Load(tag, step.is_lower.data()));
      v = hn::IfThenElse(is_lower, hn::Min(v, other), hn::Max(v, other));
    }
  }
  return v;
}

// Partners that fit a vector: sorted without a branch that depends on how many they are. Writes
// whole vectors; what is too much is overwritten by the next body's.
HWY_INLINE void write_short(const uint32_t* partners, size_t count, uint32_t body, Pair* out) {
  const PartnerTag tag;
  const Partners all =
      hn::IfThenElse(hn::FirstN(tag, count), hn::LoadU(tag, partners), hn::Set(tag, 0xffffffffu));
  hn::StoreInterleaved2(hn::Set(tag, body), sort_lanes(all), tag, &out->a);
}

// A few more: every partner's place is the number of smaller ones.
HWY_INLINE void write_by_rank(const uint32_t* partners, size_t count, uint32_t body, Pair* out) {
  const PartnerTag tag;
  for (size_t i = 0; i < count; ++i) {
    const Partners one = hn::Set(tag, partners[i]);
    size_t rank = 0;
    for (size_t k = 0; k < count; k += kLanes) {
      const auto smaller = hn::Lt(hn::LoadU(tag, partners + k), one);
      rank += hn::CountTrue(tag, hn::And(smaller, hn::FirstN(tag, count - k)));
    }
    out[rank] = {body, partners[i]};
  }
}

enum class Bodies { with_pairs, mostly_alone };

template <Bodies kBodies>
HWY_INLINE void write_all(const PartnerLists& lists, Pair* out) {
  constexpr size_t kRanked = 64;
  const size_t end = lists.first[lists.bodies];
  for (size_t i = 0; i < lists.bodies; ++i) {
    const size_t begin = lists.first[i];
    const size_t count = lists.first[i + 1] - begin;
    if (kBodies == Bodies::mostly_alone && HWY_LIKELY(count == 0)) continue;
    const uint32_t body = lists.first_body + static_cast<uint32_t>(i);
    const uint32_t* partners = lists.partners + begin;
    if (HWY_LIKELY(count <= kLanes && begin + kLanes <= end)) {
      write_short(partners, count, body, out + begin);
    } else if (count <= kRanked) {
      write_by_rank(partners, count, body, out + begin);
    } else {
      for (size_t k = 0; k < count; ++k) out[begin + k] = {body, partners[k]};
      std::sort(out + begin, out + begin + count);
    }
  }
}

void write_sorted(const PartnerLists& lists, Pair* out) {
  const size_t pairs = lists.first[lists.bodies];
  if (pairs < lists.bodies / 2) {
    write_all<Bodies::mostly_alone>(lists, out);
  } else {
    write_all<Bodies::with_pairs>(lists, out);
  }
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(write_sorted);

}  // namespace

void write_sorted(const PartnerLists& lists, Pair* out) {
  CAROM_DISPATCH(write_sorted)(lists, out);
}

}  // namespace carom
#endif  // HWY_ONCE
