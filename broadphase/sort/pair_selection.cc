#include "broadphase/sort/pair_selection.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace carom {
namespace {

constexpr size_t kPairsPerBlock = 4096;

using Place = std::span<const Pair>::iterator;

// The first of the sorted pairs [begin, end) that is not before `pair`. Takes steps of 1, 2, 4, ...
// and then halves the last one, since it is mostly near.
Place advance_to(Place begin, Place end, Pair pair) {
  ptrdiff_t step = 1;
  while (step < end - begin && begin[step] < pair) {
    begin += step;
    step *= 2;
  }
  return std::lower_bound(begin, begin + std::min(step, end - begin), pair);
}

// Moves the pairs that are not excluded to the front, and returns how many they are.
size_t drop_excluded(std::span<const Pair> excluded, const PairDigest* digest,
                     std::span<Pair> pairs) {
  Place next = std::lower_bound(excluded.begin(), excluded.end(), pairs.front());
  const Place end = std::upper_bound(next, excluded.end(), pairs.back());
  if (next == end) return pairs.size();
  size_t kept = 0;
  for (const Pair pair : pairs) {
    bool is_excluded = false;
    if (!digest || digest->may_hold(pair)) {
      next = advance_to(next, end, pair);
      is_excluded = next != end && *next == pair;
    }
    pairs[kept] = pair;
    kept += !is_excluded;
  }
  return kept;
}

// The same for the pairs that the predicate keeps.
size_t ask(const PairPredicate& predicate, std::span<Pair> pairs) {
  if (pairs.empty()) return 0;
  std::array<uint8_t, kPairsPerBlock> keep;
  std::fill_n(keep.begin(), pairs.size(), uint8_t{1});
  predicate(pairs, {keep.data(), pairs.size()});
  size_t kept = 0;
  for (size_t i = 0; i < pairs.size(); ++i) {
    pairs[kept] = pairs[i];
    kept += keep[i] != 0;
  }
  return kept;
}

}  // namespace

void PairSelection::run(std::span<const Pair> excluded, const PairDigest* digest,
                        const PairPredicate* predicate, Parallelism parallelism,
                        std::vector<Pair>& pairs) {
  assert(std::is_sorted(excluded.begin(), excluded.end()));
  if (pairs.empty() || (excluded.empty() && !predicate)) return;
  kept_.resize(block_count(pairs.size(), kPairsPerBlock));
  for_each_block(pairs.size(), kPairsPerBlock, parallelism,
                 [&](size_t block, size_t begin, size_t end) {
                   const std::span<Pair> here(pairs.data() + begin, end - begin);
                   const size_t left = drop_excluded(excluded, digest, here);
                   kept_[block] = predicate ? ask(*predicate, here.first(left)) : left;
                 });
  auto end = pairs.begin();
  for (size_t block = 0; block < kept_.size(); ++block) {
    const auto first = pairs.begin() + static_cast<ptrdiff_t>(block * kPairsPerBlock);
    const auto last = first + static_cast<ptrdiff_t>(kept_[block]);
    end = first == end ? last : std::move(first, last, end);
  }
  pairs.erase(end, pairs.end());
}

}  // namespace carom
