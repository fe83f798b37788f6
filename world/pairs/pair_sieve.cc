#include "world/pairs/pair_sieve.h"

#include "world/pairs/pair_history.h"
#include "world/store/columns.h"

namespace carom {

void PairSieve::run(const Sweeps& sweeps, const PresentBounds& bounds, Parallelism parallelism,
                    std::vector<Pair>& pairs) {
  lists_.reset(block_count(pairs.size(), kPairsPerMergeBlock));
  for_each_block(
      pairs.size(), kPairsPerMergeBlock, parallelism, [&](size_t block, size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
          const Pair pair = pairs[i];
          const bool stays =
              sweeps.looks_ahead(pair.a) || sweeps.looks_ahead(pair.b) || bounds.meet(pair);
          if (stays) lists_[block].push_back(pair);
        }
      });
  lists_.concatenate(pairs, parallelism);
}

}  // namespace carom
