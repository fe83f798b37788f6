// The digest of a list of pairs knows all of its pairs, and few others.
#include "broadphase/sort/pair_digest.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "oracle/random.h"

namespace carom::test {
namespace {

using oracle::Random;

TEST(PairDigest, HoldsAllOfTheListAndFewOthers) {
  for (const size_t count : {1, 2, 3, 4, 5, 100, 20'000}) {
    // Indices of few bodies, close together, of all that are possible.
    for (const uint64_t bodies : {uint64_t{300}, uint64_t{50'000}, uint64_t{1} << 32}) {
      Random random(count + bodies);
      const auto draw = [&] {
        return Pair{static_cast<uint32_t>(random.below(bodies)),
                    static_cast<uint32_t>(random.below(bodies))};
      };
      std::vector<Pair> pairs(count);
      std::generate(pairs.begin(), pairs.end(), draw);
      std::sort(pairs.begin(), pairs.end());
      PairDigest digest;
      digest.build(pairs);
      for (const Pair pair : pairs) EXPECT_TRUE(digest.may_hold(pair));
      size_t others = 0, held = 0;
      while (others < 20'000) {
        const Pair pair = draw();
        if (std::binary_search(pairs.begin(), pairs.end(), pair)) continue;
        ++others;
        held += digest.may_hold(pair);
      }
      EXPECT_LT(held, others / 25) << count << " pairs of " << bodies << " bodies";
      EXPECT_LE(digest.bytes(), 4 * count + 16);
    }
  }
}

// A list whose pairs have one first body, and bodies behind the last first one.
TEST(PairDigest, OfOneFirstBody) {
  std::vector<Pair> pairs;
  for (uint32_t b = 8; b < 5000; b += 2) pairs.push_back({7, b});
  PairDigest digest;
  digest.build(pairs);
  for (const Pair pair : pairs) EXPECT_TRUE(digest.may_hold(pair));
  EXPECT_FALSE(digest.may_hold({100'000, 100'001}));
  EXPECT_FALSE(digest.may_hold({0xfffffffe, 0xffffffff}));
  digest.build({});
  EXPECT_FALSE(digest.may_hold({7, 8}));
}

TEST(PairDigest, OfTheNextListForgetsTheLastOne) {
  const std::vector<Pair> first = {{1, 2}, {3, 4}}, second = {{5, 6}};
  PairDigest digest;
  digest.build(first);
  digest.build(second);
  EXPECT_TRUE(digest.may_hold({5, 6}));
  EXPECT_FALSE(digest.may_hold({1, 2}) && digest.may_hold({3, 4}));
}

}  // namespace
}  // namespace carom::test
