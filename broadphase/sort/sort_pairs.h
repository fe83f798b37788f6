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

// The sorter keeps its working memory between calls.
class PairSorter {
 public:
  // Replaces `out` by all pairs of `found`, sorted. All bodies are below `body_count`, and no pair
  // occurs twice.
  void sort(std::span<const PairList> found, size_t body_count, Parallelism parallelism,
            std::vector<Pair>& out, Scratch& scratch);

  size_t bytes() const;

 private:
  // Consecutive bodies from first_body on, and their pairs.
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

  std::vector<uint32_t> offsets_;  // one for each list of `found` and bucket
  std::vector<uint32_t> bucket_begin_;
  // In scratch memory, only during sort().
  std::span<Pair> buckets_;
  std::span<uint32_t> first_;     // place of each body's first pair; two more a bucket
  std::span<uint32_t> partners_;  // one a pair, padded a bucket
};

}  // namespace carom
