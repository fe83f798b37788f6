#include "broadphase/sort/pair_digest.h"

#include <algorithm>

namespace carom {

void PairDigest::build(std::span<const Pair> pairs) {
  words_.clear();
  if (pairs.empty()) return;
  const uint64_t bodies = uint64_t{pairs.back().a} + 1, words = pairs.size() / kPairsPerWord + 1;
  words_of_body_ =
      static_cast<uint32_t>(std::clamp(words / bodies, uint64_t{1}, uint64_t{1} << 20));
  words_per_body_ = words < bodies ? (words << 32) / bodies : uint64_t{words_of_body_} << 32;
  words_.assign((pairs.back().a * words_per_body_ >> 32) + words_of_body_, 0);
  for (const Pair pair : pairs) {
    const uint32_t hash = hash_of(pair);
    words_[word_of(pair.a, hash)] |= bits_of(hash);
  }
}

}  // namespace carom
