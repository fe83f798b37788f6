// The list of excluded pairs against a plain set.
#include "world/store/excluded_pairs.h"

#include <gtest/gtest.h>

#include <set>

#include "oracle/random.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using oracle::Random;

TEST(ExcludedPairs, AreThoseOfASet) {
  size_t excluded = 0, inherited = 0;
  for (uint64_t seed = 0; seed < rounds(300); ++seed) {
    Random random(seed);
    const size_t bodies = 2 + random.below(12);
    ExcludedPairs pairs;
    std::set<Pair> expected;
    for (int i = 0; i < 300; ++i) {
      const auto a = static_cast<uint32_t>(random.below(bodies));
      const auto b = static_cast<uint32_t>(random.below(bodies));
      if (random.chance(0.1)) {
        pairs.remove_body(a);
        inherited += std::erase_if(expected, [&](Pair pair) { return pair.a == a || pair.b == a; });
      } else if (a != b) {
        const Pair pair = {std::min(a, b), std::max(a, b)};
        if (random.chance(0.7)) {
          pairs.exclude({a, b});
          expected.insert(pair);
        } else {
          pairs.include_again({a, b});
          expected.erase(pair);
        }
        EXPECT_EQ(pairs.contains({b, a}), expected.contains(pair));
      }
      if (random.chance(0.15)) {
        pairs.update();
        EXPECT_FALSE(pairs.has_changes());
        const std::vector<Pair> got(pairs.pairs().begin(), pairs.pairs().end());
        ASSERT_EQ(got, std::vector<Pair>(expected.begin(), expected.end())) << seed;
        excluded += got.size();
        EXPECT_EQ(got.empty(), pairs.bytes() == 0);
      }
      for (uint32_t x = 0; x < bodies; ++x) {
        for (uint32_t y = x + 1; y < bodies; ++y) {
          ASSERT_EQ(pairs.contains({x, y}), expected.contains({x, y}));
        }
      }
    }
  }
  EXPECT_GT(excluded, rounds(10000));
  EXPECT_GT(inherited, rounds(5000));
}

TEST(ExcludedPairs, OfBodiesWithoutAnyLeaveNoTrace) {
  ExcludedPairs pairs;
  pairs.include_again({3, 4});
  pairs.remove_body(3);
  EXPECT_FALSE(pairs.has_changes());
  EXPECT_EQ(pairs.bytes(), 0u);
  pairs.exclude({9, 2});
  pairs.update();
  pairs.remove_body(3);
  pairs.remove_body(100);
  EXPECT_FALSE(pairs.has_changes());
  pairs.remove_body(9);
  EXPECT_TRUE(pairs.has_changes());
}

TEST(ExcludedPairs, AMillionOneByOne) {
  ExcludedPairs pairs;
  for (uint32_t i = 0; i < 1'000'000; ++i) {
    const auto a = static_cast<uint32_t>(uint64_t{i} * 2654435761u % 1'000'000);
    pairs.exclude({a + 1, a});
  }
  pairs.update();
  ASSERT_EQ(pairs.pairs().size(), 1'000'000u);
  for (uint32_t i = 0; i < 1'000'000; ++i) ASSERT_EQ(pairs.pairs()[i], (Pair{i, i + 1}));
  for (uint32_t i = 0; i < 1'000'001; i += 2) pairs.remove_body(i);
  pairs.update();
  EXPECT_TRUE(pairs.pairs().empty());
  EXPECT_EQ(pairs.bytes(), 0u);
}

}  // namespace
}  // namespace carom::test
