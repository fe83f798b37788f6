// A digest of a list of pairs: most pairs that are not in the list are told apart by a look at one
// word, without a search of the list.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "carom/results/pair.h"

namespace carom {

// A Bloom filter in words of 64 bits (Putze, Sanders, Singler, "Cache-, Hash- and Space-Efficient
// Bloom Filters", 2007): a pair sets two bits of one word. Words are in order of the first body, so
// that pairs in order walk through memory in order.
class PairDigest {
 public:
  // The list is sorted by (a, b).
  void build(std::span<const Pair> pairs);

  // True of every pair of the list, and of about one in a hundred others if the list has about as
  // many pairs of each first body. False of all if the list is empty.
  bool may_hold(Pair pair) const {
    const uint32_t hash = hash_of(pair);
    const size_t word = word_of(pair.a, hash);
    const uint64_t bits = bits_of(hash);
    return word < words_.size() && (words_[word] & bits) == bits;
  }

  size_t bytes() const { return words_.capacity() * sizeof(uint64_t); }

 private:
  static constexpr size_t kPairsPerWord = 2;

  // Of multiplicative hashing (Knuth, "The Art of Computer Programming", 6.4) the upper bits count.
  static uint32_t hash_of(Pair pair) { return pair.a * 0x85ebca77u + pair.b * 0x9e3779b1u; }
  static uint64_t bits_of(uint32_t hash) {
    return uint64_t{1} << (hash >> 26) | uint64_t{1} << (hash >> 20 & 63);
  }
  size_t word_of(uint32_t a, uint32_t hash) const {
    const uint64_t among = uint64_t{hash & 0xfffff} * words_of_body_ >> 20;
    return (a * words_per_body_ >> 32) + among;
  }

  std::vector<uint64_t> words_;
  uint64_t words_per_body_ = 0;  // from the start of one body's words to the next; in 2^-32
  uint32_t words_of_body_ = 1;   // the pairs of one body fall into so many
};

}  // namespace carom
