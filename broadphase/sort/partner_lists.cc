#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "broadphase/sort/partner_lists.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <algorithm>
#include <array>
#include <bit>

#include "broadphase/sort/partner_lists.h"
#include "simd/compress-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// Most bodies have few partners, for which narrow vectors are enough.
constexpr size_t kNarrow = std::min<size_t>(4, kLanes);
constexpr size_t kMiddle = std::min<size_t>(8, kLanes);

template <size_t kWidth>
using PartnerTag = hn::CappedTag<uint32_t, kWidth>;
template <size_t kWidth>
using Partners = hn::Vec<PartnerTag<kWidth>>;

// One step of a sorting network: compares every lane with the lane whose index differs by the bits
// of `flip`.
template <size_t kWidth>
struct NetworkStep {
  HWY_ALIGN std::array<int32_t, kWidth> other{};
  // all bits set where the lane keeps the smaller number
  HWY_ALIGN std::array<uint32_t, kWidth> is_lower{};

  constexpr NetworkStep() = default;
  constexpr explicit NetworkStep(size_t flip) {
    for (size_t lane = 0; lane < kWidth; ++lane) {
      other[lane] = static_cast<int32_t>(lane ^ flip);
      is_lower[lane] = lane < (lane ^ flip) ? 0xffffffffu : 0;
    }
  }
};

constexpr size_t step_count(size_t width) {
  size_t steps = 0;
  for (size_t size = 2, merges = 1; size <= width; size *= 2) steps += merges++;
  return steps;
}

// Batcher's bitonic network ("Sorting networks and their applications", 1968). It merges two sorted
// halves; the first step of a merge reverses the second half.
template <size_t kWidth>
constexpr auto make_sorting_network() {
  std::array<NetworkStep<kWidth>, step_count(kWidth)> network{};
  size_t step = 0;
  for (size_t size = 2; size <= kWidth; size *= 2) {
    network[step++] = NetworkStep<kWidth>(size - 1);
    for (size_t flip = size / 4; flip > 0; flip /= 2) network[step++] = NetworkStep<kWidth>(flip);
  }
  return network;
}

// Sorts lanes that rise and then fall, or fall and then rise.
constexpr auto make_merging_network() {
  std::array<NetworkStep<kLanes>, std::countr_zero(kLanes)> network{};
  size_t step = 0;
  for (size_t flip = kLanes / 2; flip > 0; flip /= 2) network[step++] = NetworkStep<kLanes>(flip);
  return network;
}

template <size_t kWidth>
inline constexpr auto kSortingNetwork = make_sorting_network<kWidth>();
inline constexpr auto kMergingNetwork = make_merging_network();

template <size_t kWidth, class Network>
HWY_INLINE Partners<kWidth> run(const Network& network, Partners<kWidth> v) {
  const PartnerTag<kWidth> tag;
  for (const NetworkStep<kWidth>& step : network) {
    const auto other = hn::TableLookupLanes(v, hn::SetTableIndices(tag, step.other.data()));
    const auto is_lower = hn::MaskFromVec(hn::Load(tag, step.is_lower.data()));
    v = hn::IfThenElse(is_lower, hn::Min(v, other), hn::Max(v, other));
  }
  return v;
}

template <size_t kWidth>
HWY_INLINE Partners<kWidth> sorted_partners(const uint32_t* partners, size_t count) {
  const PartnerTag<kWidth> tag;
  const auto loaded =
      hn::IfThenElse(hn::FirstN(tag, count), hn::LoadU(tag, partners), hn::Set(tag, 0xffffffffu));
  return run<kWidth>(kSortingNetwork<kWidth>, loaded);
}

template <size_t kWidth>
HWY_INLINE void write_pairs(uint32_t body, Partners<kWidth> sorted, Pair* out) {
  const PartnerTag<kWidth> tag;
  store_interleaved(tag, hn::Set(tag, body), order_for_interleaving(tag, sorted), &out->a);
}

// Sorts partners that fit into a vector, without a branch that depends on their number. Writes a
// whole vector; the next body overwrites the surplus.
template <size_t kWidth>
HWY_INLINE void write_one_vector(const uint32_t* partners, size_t count, uint32_t body, Pair* out) {
  write_pairs<kWidth>(body, sorted_partners<kWidth>(partners, count), out);
}

// The same for two vectors.
HWY_INLINE void write_two_vectors(const uint32_t* partners, size_t count, uint32_t body,
                                  Pair* out) {
  const auto first = sorted_partners<kLanes>(partners, kLanes);
  const auto second = sorted_partners<kLanes>(partners + kLanes, count - kLanes);
  const auto falling = hn::Reverse(PartnerTag<kLanes>(), second);
  write_pairs<kLanes>(body, run<kLanes>(kMergingNetwork, hn::Min(first, falling)), out);
  write_pairs<kLanes>(body, run<kLanes>(kMergingNetwork, hn::Max(first, falling)), out + kLanes);
}

// For more partners: the place of each is the number of smaller ones.
HWY_INLINE void write_by_rank(const uint32_t* partners, size_t count, uint32_t body, Pair* out) {
  const PartnerTag<kLanes> tag;
  for (size_t i = 0; i < count; ++i) {
    const auto one = hn::Set(tag, partners[i]);
    size_t rank = 0;
    for (size_t k = 0; k < count; k += kLanes) {
      const auto smaller = hn::Lt(hn::LoadU(tag, partners + k), one);
      rank += hn::CountTrue(tag, hn::And(smaller, hn::FirstN(tag, count - k)));
    }
    out[rank] = {body, partners[i]};
  }
}

// Most bodies have up to kFirst partners.
template <size_t kFirst>
HWY_INLINE void write_list(const PartnerLists& lists, size_t i, Pair* out) {
  constexpr size_t kRanked = 64;
  const size_t end = lists.first[lists.bodies];
  const size_t begin = lists.first[i];
  const size_t count = lists.first[i + 1] - begin;
  const uint32_t body = lists.first_body + static_cast<uint32_t>(i);
  const uint32_t* partners = lists.partners + begin;
  if (HWY_LIKELY(count <= kFirst && begin + kFirst <= end)) {
    write_one_vector<kFirst>(partners, count, body, out + begin);
  } else if (count <= kLanes && begin + kLanes <= end) {
    write_one_vector<kLanes>(partners, count, body, out + begin);
  } else if (count <= 2 * kLanes && count > kLanes && begin + 2 * kLanes <= end) {
    write_two_vectors(partners, count, body, out + begin);
  } else if (count <= kRanked) {
    write_by_rank(partners, count, body, out + begin);
  } else {
    for (size_t k = 0; k < count; ++k) out[begin + k] = {body, partners[k]};
    std::sort(out + begin, out + begin + count);
  }
}

template <size_t kFirst>
HWY_INLINE void write_all(const PartnerLists& lists, Pair* out) {
  for (size_t i = 0; i < lists.bodies; ++i) write_list<kFirst>(lists, i, out);
}

// For bodies of which most have no partner.
HWY_INLINE void write_few(const PartnerLists& lists, Pair* out) {
  for (size_t i = 0; i < lists.bodies; ++i) {
    if (HWY_UNLIKELY(lists.first[i + 1] > lists.first[i])) write_list<kNarrow>(lists, i, out);
  }
}

void write_sorted(const PartnerLists& lists, Pair* out) {
  const size_t pairs = lists.first[lists.bodies];
  if (pairs < lists.bodies / 2) {
    write_few(lists, out);
  } else if (pairs < 2 * lists.bodies) {
    write_all<kNarrow>(lists, out);
  } else if (pairs < 8 * lists.bodies) {
    write_all<kMiddle>(lists, out);
  } else {
    write_all<kLanes>(lists, out);
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
