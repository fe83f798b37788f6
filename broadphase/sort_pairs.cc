#include "broadphase/sort_pairs.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace carom {
namespace {

constexpr size_t kBuckets = 256;

// Bodies a bucket: a power of two.
int bucket_shift(size_t body_count) {
  return std::max(0, static_cast<int>(std::bit_width(body_count)) - std::countr_zero(kBuckets));
}

bool by_second(const Pair& x, const Pair& y) { return x.b < y.b; }

// Pairs of one bucket, from `in` to `out`: by counting on a, then by b within equal a. Few pairs
// share an a, mostly.
void sort_bucket(const Pair* in, size_t count, uint32_t* counts, uint32_t first_body, size_t bodies,
                 Pair* out) {
  std::fill_n(counts, bodies, 0u);
  for (size_t i = 0; i < count; ++i) ++counts[in[i].a - first_body];
  uint32_t offset = 0;
  for (size_t i = 0; i < bodies; ++i) offset += std::exchange(counts[i], offset);
  for (size_t i = 0; i < count; ++i) out[counts[in[i].a - first_body]++] = in[i];
  for (size_t i = 0, begin = 0; i < bodies; begin = counts[i++]) {
    std::sort(out + begin, out + counts[i], by_second);
  }
}

}  // namespace

void PairSorter::sort(const BlockLists<Pair>& found, size_t body_count, Parallelism parallelism,
                      std::vector<Pair>& out) {
  const int shift = bucket_shift(body_count);
  const size_t blocks = found.blocks();
  offsets_.assign(blocks * kBuckets, 0);
  for_each_block(blocks, 1, parallelism, [&](size_t block, size_t, size_t) {
    uint32_t* counts = offsets_.data() + block * kBuckets;
    for (const Pair& pair : found[block]) ++counts[pair.a >> shift];
  });

  std::array<size_t, kBuckets + 1> bucket_begin{};
  uint32_t offset = 0;
  for (size_t bucket = 0; bucket < kBuckets; ++bucket) {
    bucket_begin[bucket] = offset;
    for (size_t block = 0; block < blocks; ++block) {
      offset += std::exchange(offsets_[block * kBuckets + bucket], offset);
    }
  }
  bucket_begin[kBuckets] = offset;

  buckets_.resize(offset);
  for_each_block(blocks, 1, parallelism, [&](size_t block, size_t, size_t) {
    uint32_t* offsets = offsets_.data() + block * kBuckets;
    for (const Pair& pair : found[block]) buckets_[offsets[pair.a >> shift]++] = pair;
  });

  out.resize(offset);
  counts_.resize(body_count);
  for_each_block(kBuckets, 1, parallelism, [&](size_t bucket, size_t, size_t) {
    const size_t begin = bucket_begin[bucket];
    const size_t count = bucket_begin[bucket + 1] - begin;
    if (count == 0) return;
    const size_t first_body = bucket << shift;
    const size_t bodies = std::min(body_count - first_body, size_t{1} << shift);
    sort_bucket(buckets_.data() + begin, count, counts_.data() + first_body,
                static_cast<uint32_t>(first_body), bodies, out.data() + begin);
  });
}

size_t PairSorter::bytes() const {
  return buckets_.capacity() * sizeof(Pair) +
         (offsets_.capacity() + counts_.capacity()) * sizeof(uint32_t);
}

}  // namespace carom
