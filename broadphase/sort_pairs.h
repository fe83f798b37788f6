// Pairs as a search found them -> pairs sorted by (a, b).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "carom/kernel/pair.h"
#include "kernel/block_lists.h"

namespace carom {

// Keeps its working memory from call to call.
class PairSorter {
 public:
  // Replaces `out` by all pairs of `found`, sorted. Indices are below `body_count`; no pair occurs
  // twice.
  void sort(const BlockLists<Pair>& found, size_t body_count, Parallelism parallelism,
            std::vector<Pair>& out);

  size_t bytes() const;

 private:
  std::vector<Pair> buckets_;
  std::vector<uint32_t> offsets_;  // one a block of `found` and bucket
  std::vector<uint32_t> counts_;   // one a body
};

}  // namespace carom
