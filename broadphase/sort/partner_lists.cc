#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "broadphase/sort/partner_lists.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <algorithm>
#include <array>
#include <bit>

#include "broadphase/sort/partner_lists.h"
#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

using PartnerTag = hn::RebindToUnsigned<FloatTag>;
using Partners = hn::Vec<PartnerTag>;

// One step of a sorting network: compares every lane with the lane whose index differs by the bits
// of `flip`.
struct NetworkStep {
  HWY_ALIGN std::array<int32_t, kLanes> other{};
  // all bits set where the lane keeps the smaller number
  HWY_ALIGN std::array<uint32_t, kLanes> is_lower{};

  constexpr NetworkStep() = default;
  constexpr explicit NetworkStep(size_t flip) {
    for (size_t lane = 0; lane < kLanes; ++lane) {
      other[lane] = static_cast<int32_t>(lane ^ flip);
      is_lower[lane] = lane < (lane ^ flip) ? 0xffffffffu : 0;
    }
  }
};

constexpr size_t step_count() {
  size_t steps = 0;
  for (size_t size = 2, merges = 1; size <= kLanes; size *= 2) steps += merges++;
  return steps;
}

// Batcher's bitonic network ("Sorting networks and their applications", 1968). It merges two sorted
// halves; the first step of a merge reverses the second half.
constexpr auto make_sorting_network() {
  std::array<NetworkStep, step_count()> network{};
  size_t step = 0;
  for (size_t size = 2; size <= kLanes; size *= 2) {
    network[step++] = NetworkStep(size - 1);
    for (size_t flip = size / 4; flip > 0; flip /= 2) network[step++] = NetworkStep(flip);
  }
  return network;
}

// Sorts lanes that rise and then fall, or fall and then rise.
constexpr auto make_merging_network() {
  std::array<NetworkStep, std::countr_zero(kLanes)> network{};
  size_t step = 0;
  for (size_t flip = kLanes / 2; flip > 0; flip /= 2) network[step++] = NetworkStep(flip);
  return network;
}

inline constexpr auto kSortingNetwork = make_sorting_network();
inline constexpr auto kMergingNetwork = make_merging_network();

template <class Network>
HWY_INLINE Partners run(const Network& network, Partners v) {
  const PartnerTag tag;
  for (const NetworkStep& step : network) {
    const Partners other = hn::TableLookupLanes(v, hn::SetTableIndices(tag, step.other.data()));
    const auto is_lower = hn::MaskFromVec(hn::Load(tag, step.is_lower.data()));
    v = hn::IfThenElse(is_lower, hn::Min(v, other), hn::Max(v, other));
  }
  return v;
}

HWY_INLINE Partners load_partners(const uint32_t* partners, size_t count) {
  const PartnerTag tag;
  return hn::IfThenElse(hn::FirstN(tag, count), hn::LoadU(tag, partners),
                        hn::Set(tag, 0xffffffffu));
}

// Sorts partners that fit into a vector, without a branch that depends on their number. Writes a
// whole vector; the next body overwrites the surplus.
HWY_INLINE void write_one_vector(const uint32_t* partners, size_t count, uint32_t body, Pair* out) {
  const PartnerTag tag;
  const Partners sorted = run(kSortingNetwork, load_partners(partners, count));
  hn::StoreInterleaved2(hn::Set(tag, body), sorted, tag, &out->a);
}

// The same for two vectors.
HWY_INLINE void write_two_vectors(const uint32_t* partners, size_t count, uint32_t body,
                                  Pair* out) {
  const PartnerTag tag;
  const Partners first = run(kSortingNetwork, load_partners(partners, kLanes));
  const Partners second = run(kSortingNetwork, load_partners(partners + kLanes, count - kLanes));
  const Partners falling = hn::Reverse(tag, second);
  const Partners less = run(kMergingNetwork, hn::Min(first, falling));
  const Partners more = run(kMergingNetwork, hn::Max(first, falling));
  hn::StoreInterleaved2(hn::Set(tag, body), less, tag, &out->a);
  hn::StoreInterleaved2(hn::Set(tag, body), more, tag, &out[kLanes].a);
}

// For more partners: the place of each is the number of smaller ones.
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
      write_one_vector(partners, count, body, out + begin);
    } else if (count <= 2 * kLanes && count > kLanes && begin + 2 * kLanes <= end) {
      write_two_vectors(partners, count, body, out + begin);
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
