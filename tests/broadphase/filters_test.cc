// Which pairs the filters leave: every combination against brute force, and each rule by itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <mutex>

#include "carom/base/thread_arena.h"
#include "carom/broadphase/find_pairs.h"
#include "tests/support/boxes.h"
#include "tests/support/isas.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

constexpr FilterRule kRules[] = {FilterRule::both, FilterRule::either};

TEST(PairFilters, EveryCombinationIsAsByBruteForce) {
  const Boxes boxes = make_boxes(BoxFamily::random, 500, 3);
  const std::vector<Pair> all = plain_pairs(boxes);
  Filters filters(boxes.size(), 4);
  filters.exclude_some(all, boxes.size(), 5);
  for (unsigned parts = 0; parts < Filters::kAllParts; ++parts) {
    const PairFilter filter = filters.view(parts);
    std::vector<Pair> expected;
    for (const Pair pair : all) {
      if (test::may_meet(filter, pair.a, pair.b)) expected.push_back(pair);
    }
    EXPECT_FALSE(expected.empty());
    for (const BroadphaseMethod method : kAllMethods) {
      const std::vector<Pair> got = found_pairs(boxes, method, filter);
      ASSERT_TRUE(got == expected) << "parts " << parts << ", " << carom::name(method) << ", "
                                   << difference(got, expected, boxes);
    }
  }
}

// Each filter forbids some pairs that the others allow.
TEST(PairFilters, EveryOneCounts) {
  const Boxes boxes = make_boxes(BoxFamily::random, 700, 3);
  Filters filters(boxes.size(), 4);
  filters.exclude_some(plain_pairs(boxes), boxes.size(), 5);
  const auto pairs = [&](unsigned parts) { return plain_pairs(boxes, filters.view(parts)).size(); };
  const size_t all = pairs(Filters::kAllParts - 1);
  EXPECT_GT(all, 10u);
  for (const unsigned part : {2u, 4u, 8u, 16u, 64u, 128u}) {
    EXPECT_GT(pairs(Filters::kAllParts - 1 - part), all) << part;
  }
  EXPECT_GT(pairs(1 + 32), pairs(1)) << "either is the wider rule";
  EXPECT_GT(pairs(0), pairs(1 + 32));
}

TEST(PairFilters, OnEveryIsaAndOnThreads) {
  const Boxes boxes = make_boxes(BoxFamily::random, 6000, 7);
  const std::vector<Pair> all = plain_pairs(boxes);
  Filters filters(boxes.size(), 8);
  filters.exclude_some(all, boxes.size(), 9);
  for (const unsigned parts : {64u, 128u, 192u, 255u, 223u, 24u}) {
    const PairFilter filter = filters.view(parts);
    const std::vector<Pair> expected = plain_pairs(boxes, filter);
    EXPECT_GT(expected.size(), 100u);
    EXPECT_LT(expected.size(), all.size());
    for_each_isa([&] {
      for (const BroadphaseMethod method : kAllMethods) {
        EXPECT_TRUE(found_pairs(boxes, method, filter) == expected);
      }
    });
    ThreadArena arena(4);
    arena.run([&] {
      for (const BroadphaseMethod method : kAllMethods) {
        EXPECT_TRUE(found_pairs(boxes, method, filter, arena.parallelism()) == expected);
      }
    });
  }
}

// Two boxes that overlap.
class TwoBoxes : public ::testing::Test {
 protected:
  bool meet(unsigned parts, FilterRule rule = FilterRule::both) {
    PairFilter filter = f.view(parts);
    filter.rule = rule;
    const size_t pairs = found_pairs(boxes, BroadphaseMethod::automatic, filter).size();
    EXPECT_EQ(pairs == 1, test::may_meet(filter, 0, 1));
    return pairs == 1;
  }

  const Boxes boxes = Boxes(2, TestBox{{0, 0, 0}, {1, 1, 1}});
  Filters f;
};

TEST_F(TwoBoxes, OneSideIsEnoughForEither) {
  f.layer = {1, 2};
  f.mask = {2, 2};
  EXPECT_FALSE(meet(1)) << "only A lets B";
  EXPECT_TRUE(meet(1, FilterRule::either));
  f.mask = {1, 1};
  EXPECT_FALSE(meet(1)) << "only B lets A";
  EXPECT_TRUE(meet(1, FilterRule::either));
  f.mask = {2, 1};
  EXPECT_TRUE(meet(1, FilterRule::either));
  f.mask = {1, 2};
  EXPECT_FALSE(meet(1, FilterRule::either)) << "each lets itself alone";
}

TEST_F(TwoBoxes, GroupsGoBeforeLayers) {
  constexpr unsigned kLayersAndGroups = 1 + 8;
  f.layer = {1, 1};
  for (const FilterRule rule : kRules) {
    for (const uint32_t mask : {0u, 1u}) {
      f.mask = {mask, mask};
      const bool layers = mask == 1;
      f.group = {0, 0};
      EXPECT_EQ(meet(kLayersAndGroups, rule), layers);
      f.group = {-1, -2};
      EXPECT_EQ(meet(kLayersAndGroups, rule), layers) << "of different groups";
      f.group = {3, -3};
      EXPECT_EQ(meet(kLayersAndGroups, rule), layers) << "of different groups";
      f.group = {7, 7};
      EXPECT_TRUE(meet(kLayersAndGroups, rule));
      f.group = {-7, -7};
      EXPECT_FALSE(meet(kLayersAndGroups, rule));
      f.group = {INT32_MIN, INT32_MIN};
      EXPECT_FALSE(meet(kLayersAndGroups, rule));
      f.group = {INT32_MAX, INT32_MAX};
      EXPECT_TRUE(meet(kLayersAndGroups, rule));
    }
  }
}

// A positive group goes before layers and before nothing else.
TEST_F(TwoBoxes, AllElseGoesBeforeAPositiveGroup) {
  f.group = {5, 5};
  f.layer = f.mask = {0, 0};
  EXPECT_TRUE(meet(1 + 8));
  f.owner = {2, 2};
  EXPECT_FALSE(meet(1 + 8 + 2));
  f.motion = {Motion::fixed, Motion::fixed};
  EXPECT_FALSE(meet(1 + 8 + 4));
  f.space = {0, 1};
  EXPECT_FALSE(meet(1 + 8 + 16));
  f.excluded = {{0, 1}};
  EXPECT_FALSE(meet(1 + 8 + 64));
  f.predicate = [](std::span<const Pair>, std::span<uint8_t> keep) { keep[0] = 0; };
  EXPECT_FALSE(meet(1 + 8 + 128));
  f.owner = {2, 3};
  f.motion = {Motion::fixed, Motion::dynamic};
  f.space = {1, 1};
  f.excluded = {};
  f.predicate = [](std::span<const Pair>, std::span<uint8_t>) {};
  EXPECT_TRUE(meet(Filters::kAllParts - 1));
}

// n boxes that all overlap.
Boxes boxes_in_one_place(size_t n) { return Boxes(n, TestBox{{0, 0, 0}, {1, 1, 1}}); }

// The list of pairs is cut into blocks; exclude what lies at their ends, and runs of all lengths.
TEST(ExcludedPairs, AnywhereInTheList) {
  const Boxes boxes = boxes_in_one_place(150);  // 11,175 pairs, more than two blocks
  const std::vector<Pair> all = plain_pairs(boxes);
  Random random(1);
  const auto expect_without = [&](std::vector<Pair> excluded) {
    std::sort(excluded.begin(), excluded.end());
    std::vector<Pair> expected;
    std::set_difference(all.begin(), all.end(), excluded.begin(), excluded.end(),
                        std::back_inserter(expected));
    EXPECT_TRUE(found_pairs(boxes, BroadphaseMethod::sweep, {.excluded = excluded}) == expected);
    EXPECT_EQ(expected.size(), all.size() - excluded.size());
  };
  expect_without({});
  expect_without(all);
  for (const size_t at : {0, 1, 4095, 4096, 4097, 8191, 8192, 11174}) expect_without({all[at]});
  for (uint32_t round = 0; round < rounds(200, 40); ++round) {
    const double share = random.uniform(0, 1);
    const size_t run = 1 + random.below(round % 2 ? 3000 : 3);
    std::vector<Pair> excluded;
    for (size_t i = 0; i < all.size(); i += run) {
      if (!random.chance(share)) continue;
      for (size_t k = i; k < std::min(i + run, all.size()); ++k) excluded.push_back(all[k]);
    }
    expect_without(excluded);
  }
}

TEST(ExcludedPairs, ThatDoNotMeetChangeNothing) {
  const Boxes boxes = make_boxes(BoxFamily::random, 2000, 2);
  const std::vector<Pair> expected = plain_pairs(boxes);
  std::vector<Pair> excluded;
  for (uint32_t a = 0; a < 2000; ++a) {
    for (uint32_t b = a + 1; b < std::min(2000u, a + 520); ++b) excluded.push_back({a, b});
  }
  std::erase_if(excluded, [&](Pair pair) {
    return std::binary_search(expected.begin(), expected.end(), pair);
  });
  EXPECT_GT(excluded.size(), 800'000u);
  excluded.push_back({2000, 2001});  // of boxes that are not there
  for (const BroadphaseMethod method : kAllMethods) {
    EXPECT_TRUE(found_pairs(boxes, method, {.excluded = excluded}) == expected);
  }
}

TEST(ExcludedPairs, OfRestingBoxesMayChange) {
  const Boxes boxes = make_boxes(BoxFamily::random, 900, 2);
  const LaidOutBoxes memory(boxes);
  const std::vector<Pair> all = plain_pairs(boxes);
  ASSERT_GT(all.size(), 20u);
  PairFinder finder;
  std::vector<Pair> pairs;
  for (int i = 0; i < 4; ++i) finder.find(memory.view(), {}, pairs, BroadphaseMethod::grid);
  for (const Pair gone : all) {
    const std::vector<Pair> excluded = {gone};
    const PairSearch search =
        finder.find(memory.view(), {.excluded = excluded}, pairs, BroadphaseMethod::grid);
    EXPECT_EQ(search.searched, 0u) << "all boxes rest";
    EXPECT_EQ(search.pairs, all.size() - 1);
    EXPECT_EQ(pairs.size(), all.size() - 1);
    EXPECT_FALSE(std::binary_search(pairs.begin(), pairs.end(), gone));
  }
  finder.find(memory.view(), {}, pairs, BroadphaseMethod::grid);
  EXPECT_TRUE(pairs == all);
}

TEST(Predicates, AreAskedOnceAboutEveryPairThatAllElseAllows) {
  const Boxes boxes = boxes_in_one_place(150);
  Filters filters(boxes.size(), 1);
  filters.exclude_some(plain_pairs(boxes), boxes.size(), 2);
  for (const int threads : {1, 4}) {
    std::mutex mutex;
    std::vector<Pair> asked;
    std::vector<size_t> batches;
    filters.predicate = [&](std::span<const Pair> pairs, std::span<uint8_t> keep) {
      const std::scoped_lock lock(mutex);
      EXPECT_FALSE(pairs.empty());
      EXPECT_EQ(pairs.size(), keep.size());
      EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
      EXPECT_TRUE(std::all_of(keep.begin(), keep.end(), [](uint8_t flag) { return flag == 1; }));
      asked.insert(asked.end(), pairs.begin(), pairs.end());
      batches.push_back(pairs.size());
      std::fill(keep.begin(), keep.end(), uint8_t{0});
    };
    ThreadArena arena(threads);
    for (const unsigned parts : {0u, 64u, 31u + 64}) {
      asked.clear();
      batches.clear();
      arena.run([&] {
        EXPECT_TRUE(found_pairs(boxes, BroadphaseMethod::sweep, filters.view(parts + 128),
                                arena.parallelism())
                        .empty());
      });
      std::sort(asked.begin(), asked.end());
      EXPECT_TRUE(asked == plain_pairs(boxes, filters.view(parts)));
      EXPECT_LE(batches.size(), 3u);
    }
  }
}

TEST(Predicates, AreNotAskedWithoutPairs) {
  const PairPredicate never = [](std::span<const Pair>, std::span<uint8_t>) { ADD_FAILURE(); };
  const Boxes apart = {{{0, 0, 0}, {1, 1, 1}}, {{2, 0, 0}, {3, 1, 1}}};
  EXPECT_TRUE(found_pairs(apart, BroadphaseMethod::automatic, {.predicate = &never}).empty());
  EXPECT_TRUE(found_pairs({}, BroadphaseMethod::automatic, {.predicate = &never}).empty());
  const std::vector<Pair> excluded = {{0, 1}};
  EXPECT_TRUE(found_pairs(boxes_in_one_place(2), BroadphaseMethod::automatic,
                          {.excluded = excluded, .predicate = &never})
                  .empty());
}

// The limit counts what the search finds, and a caller's buffer needs room for what is left.
TEST(Predicates, AndTheLimitOfPairs) {
  const Boxes boxes = boxes_in_one_place(40);  // 780 pairs
  const LaidOutBoxes memory(boxes);
  const std::vector<Pair> excluded = {{0, 1}, {3, 7}};
  PairFinder finder;
  std::vector<Pair> pairs;
  finder.set_most_pairs(779);
  EXPECT_FALSE(finder.find(memory.view(), {.excluded = excluded}, pairs).complete);
  EXPECT_TRUE(pairs.empty());
  finder.set_most_pairs(780);
  EXPECT_EQ(finder.find(memory.view(), {.excluded = excluded}, pairs).pairs, 778u);
  EXPECT_EQ(pairs.size(), 778u);
  std::vector<Pair> buffer(778);
  EXPECT_EQ(find_pairs(memory.view(), {.excluded = excluded}, buffer), 778u);
  EXPECT_TRUE(buffer == pairs);
}

}  // namespace
}  // namespace carom::test
