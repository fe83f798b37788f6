// Boxes in many spaces: the pairs are those of brute force, however the spaces lie among the boxes.
#include <gtest/gtest.h>

#include "broadphase/halfspace_pairs.h"
#include "broadphase/space_order.h"
#include "carom/base/thread_arena.h"
#include "tests/support/boxes.h"
#include "tests/support/isas.h"

namespace carom::test {
namespace {

using Spaces = std::vector<uint32_t>;

Spaces make_spaces(size_t count, uint32_t (*space_of)(uint32_t i)) {
  Spaces spaces(count);
  for (uint32_t i = 0; i < count; ++i) spaces[i] = space_of(i);
  return spaces;
}

// Neighbours, mixed, far apart numbers, and as many in one space as a search of spaces takes or one
// more.
std::vector<Spaces> spaces_of(size_t count) {
  return {make_spaces(count, [](uint32_t i) { return i / 20; }),
          make_spaces(count, [](uint32_t i) { return i % 37; }),
          make_spaces(count, [](uint32_t i) { return 0xffffffffu - i % 41 * 0x1000000u; }),
          make_spaces(count, [](uint32_t i) { return i < 350 ? 7 : i; }),
          make_spaces(count, [](uint32_t i) { return i < 351 ? 7 : i; })};
}

TEST(BoxSpaces, HaveThePairsOfBruteForce) {
  size_t pairs = 0;
  for (int family = 0; family < kBoxFamilies; ++family) {
    for (const size_t count : {129, 600}) {
      const Boxes boxes = make_boxes(static_cast<BoxFamily>(family), count);
      for (const Spaces& spaces : spaces_of(count)) {
        PairFilter filter;
        filter.space = spaces.data();
        const std::vector<Pair> expected = plain_pairs(boxes, filter);
        for_each_isa([&] {
          const std::vector<Pair> got =
              found_pairs(boxes, BroadphaseMethod::automatic, filter, Parallelism::none, 28);
          ASSERT_TRUE(got == expected)
              << name(static_cast<BoxFamily>(family)) << ", " << difference(got, expected, boxes);
        });
        pairs += expected.size();
      }
    }
  }
  EXPECT_GT(pairs, 10'000u);
}

TEST(BoxSpaces, AreSearchedOneByOneIfTheyAreSmall) {
  const Boxes boxes = make_boxes(BoxFamily::random, 5000);
  const LaidOutBoxes laid_out(boxes);
  std::vector<Pair> pairs;
  PairFilter filter;
  for (const uint32_t a_space : {350u, 351u}) {
    Spaces spaces(boxes.size());
    for (uint32_t i = 0; i < spaces.size(); ++i) spaces[i] = i / a_space;
    filter.space = spaces.data();
    const PairSearch search = PairFinder().find(laid_out.view(), filter, pairs);
    EXPECT_EQ(search.method, a_space == 350 ? BroadphaseMethod::brute : BroadphaseMethod::grid);
    EXPECT_TRUE(pairs == plain_pairs(boxes, filter));
  }
}

TEST(BoxSpaces, AreTheSameOnThreadsAndAgain) {
  const Boxes boxes = make_boxes(BoxFamily::clustered, 6000);
  PairFinder finder;
  for (const Spaces& spaces : spaces_of(boxes.size())) {
    PairFilter filter;
    filter.space = spaces.data();
    const std::vector<Pair> expected = plain_pairs(boxes, filter);
    EXPECT_TRUE(found_pairs(finder, boxes, BroadphaseMethod::automatic, filter) == expected);
    ThreadArena arena(4);
    arena.run([&] {
      EXPECT_TRUE(found_pairs(finder, boxes, BroadphaseMethod::automatic, filter,
                              arena.parallelism()) == expected);
    });
  }
}

// More half-spaces than are tested against all boxes, each in a space of its own or two in one.
TEST(BoxSpaces, HalfspacesMeetTheBoxesOfTheirSpace) {
  Boxes boxes = make_boxes(BoxFamily::random, 900);
  const float empty = std::numeric_limits<float>::infinity();
  std::vector<WorldHalfspace> planes;
  Random random(5);
  for (uint32_t i = 0; i < boxes.size(); i += 21) {
    boxes[i] = {{empty, empty, empty}, {-empty, -empty, -empty}};
    planes.push_back(
        {.body = i,
         .normal = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)},
         .limit = random.uniform(0, 5),
         .slack = 0x1p-48});
  }
  ASSERT_GT(planes.size(), 16u);
  const LaidOutBoxes laid_out(boxes);
  for (const Spaces& spaces : spaces_of(boxes.size())) {
    PairFilter filter;
    filter.space = spaces.data();
    std::vector<Pair> expected, one, got;
    for (const WorldHalfspace& plane : planes) {
      HalfspaceSearch().find({&plane, 1}, laid_out.view(), filter, 1000, Parallelism::none, one);
      expected.insert(expected.end(), one.begin(), one.end());
    }
    std::sort(expected.begin(), expected.end());
    EXPECT_GT(expected.size(), 50u);
    HalfspaceSearch search;
    for (const size_t most : {expected.size(), expected.size() - 1}) {
      const size_t count =
          search.find(planes, laid_out.view(), filter, most, Parallelism::none, got);
      EXPECT_EQ(count, expected.size());
      EXPECT_TRUE(got == (most < count ? std::vector<Pair>() : expected));
    }
  }
}

}  // namespace
}  // namespace carom::test
