// Pairs as a search found them -> pairs sorted by (a, b).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "base/scratch.h"
#include "broadphase/sort/pair_list.h"
#include "carom/results/pair.h"

namespace carom {

// Keeps its working memory from call to call.
class PairSorter {
 public:
  // Replaces `out` by all pairs of `found`, sorted. Bodies are below `body_count`; no pair occurs
  // twice.
  void sort(std::span<const PairList> found, size_t body_count, Parallelism parallelism,
            std::vector<Pair>& out, Scratch& scratch);

  size_t bytes() const;

 private:
  // Bodies first_body, first_body + 1, ... and their pairs.
  struct Bucket {
    uint32_t first_body;
    uint32_t bodies;
    size_t first_pair;  // in the sorted list
  };

  void fill_buckets(std::span<const PairList> found, size_t body_count, int shift,
                    Parallelism parallelism);
  template <class ForEachSpan>
  void sort_bucket(size_t index, const Bucket& bucket, const ForEachSpan& for_each_span,
                   std::vector<Pair>& out);

  std::vector<uint32_t> offsets_;  // one a list of `found` and bucket
  std::vector<uint32_t> bucket_begin_;
  // In scratch memory, while pairs are sorted.
  std::span<Pair> buckets_;
  std::span<uint32_t> first_;     // where the pairs of each body begin; two more a bucket
  std::span<uint32_t> partners_;  // one a pair, padded a bucket
};

}  // namespace carom
