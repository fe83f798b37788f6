#include "broadphase/sort/sort_pairs.h"

#include <algorithm>
#include <utility>

#include "base/bucket_offsets.h"
#include "base/fetch_ahead.h"
#include "base/fresh_pages.h"
#include "broadphase/sort/partner_lists.h"

namespace carom {
namespace {

// Up to this many bodies, a counter for each fits the cache.
constexpr size_t kBodiesAtOnce = 1 << 14;
constexpr size_t kPairsPerBucket = 4096;
constexpr size_t kSparsePerBucket = 8;
constexpr size_t kMostBuckets = 512;
constexpr size_t kPairsAhead = 16;  // from where a bucket is written to where it is asked for
constexpr size_t kTasksOfFewBuckets = 16;

// Visits all pairs, from four places of the list in turn. Neighbours in the list mostly share a
// body, whose counter would not be ready again so soon.
template <class Visit>
void for_each_spread(std::span<const Pair> pairs, const Visit& visit) {
  const size_t quarter = pairs.size() / 4;
  for (size_t i = 0; i < quarter; ++i) {
    for (size_t k = 0; k < 4; ++k) visit(pairs[k * quarter + i]);
  }
  for (size_t i = 4 * quarter; i < pairs.size(); ++i) visit(pairs[i]);
}

}  // namespace

void PairSorter::sort(std::span<const PairList> found, size_t body_count, Parallelism parallelism,
                      std::vector<Pair>& out, Scratch& scratch) {
  size_t total = 0;
  for (const PairList& list : found) total += list.pairs().size();
  resize_for_overwriting(out, total);
  // So few that a counter for each body costs more than comparing them.
  const bool sparse = 8 * total < body_count;
  const bool at_once = !sparse && body_count <= kBodiesAtOnce && !uses_threads(parallelism);
  const size_t per_bucket = sparse ? kSparsePerBucket : kPairsPerBucket;
  const size_t wanted = at_once ? 1 : std::clamp<size_t>(total / per_bucket, 1, kMostBuckets);
  int shift = 0;
  while ((body_count >> shift) >= wanted) ++shift;
  const size_t buckets = (body_count >> shift) + 1;
  const size_t padding = buckets * PartnerLists::kPadding;
  const size_t distributed = buckets == 1 && !sparse ? 0 : total;
  scratch.start(
      distributed * sizeof(Pair) + (body_count + 2 * buckets + total + padding) * sizeof(uint32_t),
      3);
  buckets_ = scratch.take<Pair>(distributed);
  first_ = scratch.take<uint32_t>(body_count + 2 * buckets);
  partners_ = scratch.take<uint32_t>(total + padding);
  if (buckets == 1 && !sparse) {
    const auto all_lists = [&](const auto& visit) {
      for (const PairList& list : found) visit(list.pairs());
    };
    sort_bucket(0, {0, static_cast<uint32_t>(body_count), 0}, all_lists, out);
    return;
  }
  fill_buckets(found, body_count, shift, parallelism);
  const size_t at_a_time = std::clamp<size_t>(buckets / kTasksOfFewBuckets, 1, 4);
  for_each_block(buckets, at_a_time, parallelism, [&](size_t, size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) {
      const size_t begin = bucket_begin_[i];
      const std::span<const Pair> pairs(buckets_.data() + begin, bucket_begin_[i + 1] - begin);
      if (sparse) {
        const auto place = out.begin() + static_cast<ptrdiff_t>(begin);
        std::sort(place, std::copy(pairs.begin(), pairs.end(), place));
        continue;
      }
      const size_t first_body = i << shift;
      const size_t bodies = std::min(body_count - first_body, size_t{1} << shift);
      sort_bucket(
          i, {static_cast<uint32_t>(first_body), static_cast<uint32_t>(bodies), begin},
          [&](const auto& visit) { visit(pairs); }, out);
    }
  });
}

void PairSorter::fill_buckets(std::span<const PairList> found, size_t body_count, int shift,
                              Parallelism parallelism) {
  const size_t lists = found.size();
  const size_t buckets = (body_count >> shift) + 1;
  offsets_.assign(lists * buckets, 0);
  for_each_block(lists, 1, parallelism, [&](size_t list, size_t, size_t) {
    uint32_t* counts = offsets_.data() + list * buckets;
    for_each_spread(found[list].pairs(), [&](Pair pair) { ++counts[pair.a >> shift]; });
  });
  counts_to_offsets(lists, buckets, offsets_, bucket_begin_);
  for_each_block(lists, 1, parallelism, [&](size_t list, size_t, size_t) {
    uint32_t* offsets = offsets_.data() + list * buckets;
    for_each_spread(found[list].pairs(), [&](Pair pair) {
      Pair* const place = &buckets_[offsets[pair.a >> shift]++];
      fetch_to_write(place, kPairsAhead);
      *place = pair;
    });
  });
}

// Sorts by counting on a, then sorts the partners of each a.
template <class ForEachSpan>
void PairSorter::sort_bucket(size_t index, const Bucket& bucket, const ForEachSpan& for_each_span,
                             std::vector<Pair>& out) {
  uint32_t* first = first_.data() + bucket.first_body + 2 * index;
  uint32_t* partners = partners_.data() + bucket.first_pair + index * PartnerLists::kPadding;
  // Here each body's partners begin. The distribution moves each entry to where they end, which is
  // where the next body's begin.
  uint32_t* next = first + 1;
  std::fill_n(first, bucket.bodies + 1, 0u);
  for_each_span([&](std::span<const Pair> pairs) {
    for_each_spread(pairs, [&](Pair pair) { ++next[pair.a - bucket.first_body]; });
  });
  uint32_t offset = 0;
  for (size_t i = 0; i < bucket.bodies; ++i) offset += std::exchange(next[i], offset);
  for_each_span([&](std::span<const Pair> pairs) {
    for_each_spread(pairs,
                    [&](Pair pair) { partners[next[pair.a - bucket.first_body]++] = pair.b; });
  });
  write_sorted({partners, first, bucket.bodies, bucket.first_body}, out.data() + bucket.first_pair);
}

size_t PairSorter::bytes() const {
  return offsets_.capacity() * sizeof(uint32_t) + bucket_begin_.capacity() * sizeof(uint32_t);
}

}  // namespace carom
