// Searches that find more pairs than the limit: they count the pairs, write none, and later
// searches are unharmed.
#include <gtest/gtest.h>

#include <algorithm>

#include "carom/base/thread_arena.h"
#include "carom/broadphase/find_pairs.h"
#include "tests/support/boxes.h"
#include "tests/support/isas.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

constexpr BroadphaseMethod kMethods[] = {BroadphaseMethod::brute, BroadphaseMethod::sweep,
                                         BroadphaseMethod::grid};

Boxes heap(size_t count) { return Boxes(count, TestBox{{1, 2, 3}, {2, 3, 4}}); }

struct Found {
  PairSearch search;
  std::vector<Pair> pairs;
};

Found find(PairFinder& finder, const Boxes& boxes, BroadphaseMethod method,
           const PairFilter& filter = {}, Parallelism parallelism = Parallelism::none) {
  const LaidOutBoxes memory(boxes);
  Found found;
  found.pairs = {{3, 1}, {4, 1}};  // contents of an earlier call
  found.search = finder.find(memory.view(), filter, found.pairs, method, parallelism);
  return found;
}

void expect_complete(const Found& found, const std::vector<Pair>& expected) {
  EXPECT_TRUE(found.search.complete);
  EXPECT_EQ(found.search.pairs, expected.size());
  EXPECT_TRUE(found.pairs == expected);
}

void expect_too_many(const Found& found, size_t expected) {
  EXPECT_FALSE(found.search.complete);
  EXPECT_EQ(found.search.pairs, expected);
  EXPECT_TRUE(found.pairs.empty());
}

void expect_limits_hold(const Boxes& boxes, const PairFilter& filter, BroadphaseMethod method,
                        Parallelism parallelism = Parallelism::none) {
  const std::vector<Pair> expected = plain_pairs(boxes, filter);
  const Boxes others = make_boxes(BoxFamily::random, 300);
  const std::vector<Pair> others_expected = plain_pairs(others);
  PairFinder finder;
  for (int repeat = 0; repeat < 2; ++repeat) {  // the second time with memory for all pairs
    for (const size_t less : {size_t{1}, (expected.size() + 1) / 2, expected.size()}) {
      finder.set_most_pairs(expected.size() - less);
      for (int frame = 0; frame < 3; ++frame) {  // boxes rest from the second frame on
        expect_too_many(find(finder, boxes, method, filter, parallelism), expected.size());
      }
      finder.set_most_pairs(others_expected.size());
      expect_complete(find(finder, others, method, {}, parallelism), others_expected);
    }
    finder.set_most_pairs(expected.size());
    for (int frame = 0; frame < 3; ++frame) {
      expect_complete(find(finder, boxes, method, filter, parallelism), expected);
    }
  }
}

TEST(MostPairs, OfManyBoxesInOnePlace) {
  const size_t count = rounds(3000, 1000);
  const Boxes boxes = heap(count);
  const std::vector<Pair> expected = plain_pairs(boxes);
  ASSERT_EQ(expected.size(), count * (count - 1) / 2);
  for (const BroadphaseMethod method : kMethods) {
    SCOPED_TRACE(carom::name(method));
    PairFinder finder;
    for (const bool enough : {false, true, false}) {
      finder.set_most_pairs(expected.size() - (enough ? 0 : 1));
      const Found found = find(finder, boxes, method);
      enough ? expect_complete(found, expected) : expect_too_many(found, expected.size());
    }
  }
}

TEST(MostPairs, OnEveryInstructionSet) {
  for_each_isa([] {
    for (const BroadphaseMethod method : kMethods) {
      for (const size_t count : {2, 3, 17, 400}) expect_limits_hold(heap(count), {}, method);
    }
  });
}

TEST(MostPairs, OnThreads) {
  ThreadArena arena(4);
  arena.run([&] {
    for (const BroadphaseMethod method : kMethods) {
      expect_limits_hold(heap(1000), {}, method, arena.parallelism());
    }
  });
}

// Only pairs that the filter allows count.
TEST(MostPairs, AreCountedBehindTheFilter) {
  Filters filters(900, 2);
  for (size_t i = 0; i < filters.motion.size(); ++i) {
    filters.motion[i] = i % 50 == 0 ? Motion::dynamic : Motion::fixed;
  }
  for_each_isa([&] {
    for (const BroadphaseMethod method : kMethods) {
      for (const unsigned parts : {4u, 7u})
        expect_limits_hold(heap(900), filters.view(parts), method);
    }
  });
}

TEST(MostPairs, OfSeveralGrids) {
  const Boxes boxes = make_boxes(BoxFamily::decades, 2000);
  for (const BroadphaseMethod method : kMethods) expect_limits_hold(boxes, {}, method);
}

// Most boxes rest. The moving ones make too many pairs, and later fewer again.
TEST(MostPairs, OfBoxesThatMoveAmongOthersAtRest) {
  for (const bool among_themselves : {true, false}) {
    Boxes boxes = make_boxes(BoxFamily::random, 1000);
    PairFinder finder;
    finder.set_most_pairs(4000);
    ASSERT_LT(plain_pairs(boxes).size(), 4000u);
    for (int frame = 0; frame < 3; ++frame) {
      expect_complete(find(finder, boxes, BroadphaseMethod::grid), plain_pairs(boxes));
    }
    const Boxes before = boxes;
    for (size_t i = 0; i < 100; ++i) {
      boxes[i * 7] = among_themselves ? TestBox{{2, 2, 2}, {3, 3, 3}}
                                      : TestBox{{-1, -1, static_cast<float>(i)}, {99, 99, 99}};
    }
    const size_t many = plain_pairs(boxes).size();
    ASSERT_GT(many, 4000u);
    for (int frame = 0; frame < 4; ++frame) {
      const Found found = find(finder, boxes, BroadphaseMethod::grid);
      expect_too_many(found, many);
    }
    boxes = before;
    for (int frame = 0; frame < 4; ++frame) {
      expect_complete(find(finder, boxes, BroadphaseMethod::grid), plain_pairs(boxes));
    }
  }
}

// A new limit holds from the next search on, also for kept pairs.
TEST(MostPairs, MayBecomeFewerWhileBoxesRest) {
  Boxes boxes = make_boxes(BoxFamily::random, 1000);
  const size_t pairs = plain_pairs(boxes).size();
  for (const bool some_move : {false, true}) {
    PairFinder finder;
    for (int frame = 0; frame < 3; ++frame) find(finder, boxes, BroadphaseMethod::grid);
    finder.set_most_pairs(pairs / 2);
    if (some_move) boxes[5].upper[1] = std::nextafter(boxes[5].upper[1], kLargest);
    ASSERT_EQ(plain_pairs(boxes).size(), pairs);
    expect_too_many(find(finder, boxes, BroadphaseMethod::grid), pairs);
    expect_too_many(find(finder, boxes, BroadphaseMethod::grid), pairs);
    finder.set_most_pairs(pairs);
    expect_complete(find(finder, boxes, BroadphaseMethod::grid), plain_pairs(boxes));
  }
}

// The limit bounds the memory, whatever the number of pairs.
TEST(MostPairs, BoundTheMemory) {
  for (const BroadphaseMethod method : kMethods) {
    PairFinder finder;
    finder.set_most_pairs(10000);
    for (int frame = 0; frame < 3; ++frame) {
      EXPECT_FALSE(find(finder, heap(4000), method).search.complete);
    }
    EXPECT_LT(finder.bytes(), 8000000u) << carom::name(method) << ": 64 MB of pairs";
  }
}

}  // namespace
}  // namespace carom::test
