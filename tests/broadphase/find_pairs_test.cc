// Every search, on every instruction set, against the plainest one.
#include "carom/broadphase/find_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "carom/kernel/thread_arena.h"
#include "tests/broadphase/boxes.h"
#include "tests/support/float_modes.h"
#include "tests/support/isas.h"

namespace carom::test {
namespace {

void expect_pairs(const Boxes& boxes, const std::vector<Pair>& expected,
                  const PairFilter& filter = {}, size_t record = 0) {
  for (const BroadphaseMethod method : kAllMethods) {
    const std::vector<Pair> got = found_pairs(boxes, method, filter, Parallelism::none, record);
    ASSERT_TRUE(got == expected) << carom::name(method) << ", " << boxes.size() << " boxes, "
                                 << difference(got, expected, boxes);
  }
}

TEST(FindPairs, OfEveryFamilyAndCount) {
  std::vector<size_t> counts(71);
  std::iota(counts.begin(), counts.end(), 0);
  // Around the limit of brute force and the blocks of rows, and several of those.
  for (const size_t count : {127, 128, 129, 255, 256, 257, 600}) counts.push_back(count);
  for (int i = 0; i < kBoxFamilies; ++i) {
    const auto family = static_cast<BoxFamily>(i);
    SCOPED_TRACE(name(family));
    for (const size_t count : counts) {
      const Boxes boxes = make_boxes(family, count, count);
      const std::vector<Pair> expected = plain_pairs(boxes);
      for_each_isa([&] { expect_pairs(boxes, expected); });
      ASSERT_FALSE(HasFatalFailure());
    }
  }
}

TEST(FindPairs, OfManyBoxes) {
  for (const BoxFamily family : {BoxFamily::random, BoxFamily::clustered, BoxFamily::lattice,
                                 BoxFamily::spoilt, BoxFamily::infinite}) {
    SCOPED_TRACE(name(family));
    const Boxes boxes = make_boxes(family, 5000);
    const std::vector<Pair> expected = plain_pairs(boxes);
    EXPECT_GT(expected.size(), 1000u);
    for_each_isa([&] { expect_pairs(boxes, expected); });
  }
}

TEST(FindPairs, FamiliesHaveHitsAndMisses) {
  for (int i = 0; i < kBoxFamilies; ++i) {
    const auto family = static_cast<BoxFamily>(i);
    const size_t all = 600 * 599 / 2;
    const size_t pairs = plain_pairs(make_boxes(family, 600)).size();
    EXPECT_GT(pairs, 100u) << name(family);
    if (family != BoxFamily::one_point) {
      EXPECT_LT(pairs, all * 9 / 10) << name(family);
    }
  }
}

// Flush-to-zero and other rounding in the caller change nothing.
TEST(FindPairs, InAnyFloatMode) {
  for (const BoxFamily family : {BoxFamily::subnormal, BoxFamily::lattice, BoxFamily::any_bits}) {
    for (const size_t count : {40, 300}) {
      const Boxes boxes = make_boxes(family, count);
      const std::vector<Pair> expected = plain_pairs(boxes);
      for (const FloatMode& mode : float_modes()) {
        for (const BroadphaseMethod method : kAllMethods) {
          PairFinder finder;
          for (int repeat = 0; repeat < 2; ++repeat) {  // sorted afresh, then repaired
            const std::vector<Pair> got = [&] {
              const ScopedFloatMode scoped(mode);
              return found_pairs(finder, boxes, method);
            }();
            ASSERT_TRUE(got == expected)
                << name(family) << ", " << mode.name << ", " << carom::name(method) << ", "
                << difference(got, expected, boxes);
          }
        }
      }
    }
  }
}

// Both boxes lie in the range of subnormals; the second one is inverted there.
TEST(FindPairs, InvertedSubnormalBoxesMeetNothingInAnyFloatMode) {
  const float one = 0x1p-149f;
  const Boxes boxes = {{{0, 0, 0}, {9 * one, 1, 1}}, {{3 * one, 0, 0}, {2 * one, 1, 1}}};
  for (const FloatMode& mode : float_modes()) {
    const ScopedFloatMode scoped(mode);
    for (const BroadphaseMethod method : kAllMethods) {
      ASSERT_EQ(found_pairs(boxes, method).size(), 0u) << mode.name;
    }
  }
}

TEST(FindPairs, TouchingIsOverlapAndOneFloatApartIsNot) {
  for (int axis = 0; axis < 3; ++axis) {
    TestBox a = {{0, 0, 0}, {1, 1, 1}};
    TestBox b = a;
    b.lower[axis] = 1;
    b.upper[axis] = 2;
    for_each_isa([&] { expect_pairs({a, b}, {{0, 1}}); });
    b.lower[axis] = std::nextafter(1.0f, 2.0f);
    for_each_isa([&] { expect_pairs({b, a}, {}); });
  }
}

TEST(FindPairs, Filtered) {
  const Boxes boxes = make_boxes(BoxFamily::random, 700, 3);
  const Filters filters(boxes.size(), 4);
  size_t last = plain_pairs(boxes).size() + 1;
  for (const unsigned parts : {0u, 1u, 2u, 3u, 4u, 5u, 6u, 7u}) {
    const PairFilter filter = filters.view(parts);
    const std::vector<Pair> expected = plain_pairs(boxes, filter);
    EXPECT_FALSE(expected.empty());
    if (parts == 0 || parts == 7) {
      EXPECT_LT(expected.size(), last);
      last = expected.size();
    }
    for_each_isa([&] { expect_pairs(boxes, expected, filter); });
  }
}

TEST(FindPairs, FilterRules) {
  const Boxes boxes(2, TestBox{{0, 0, 0}, {1, 1, 1}});
  Filters f;
  const auto meet = [&](unsigned parts) {
    return found_pairs(boxes, BroadphaseMethod::automatic, f.view(parts)).size() == 1;
  };
  f.layer = {1, 2};
  f.mask = {2, 1};
  EXPECT_TRUE(meet(1));
  f.mask = {2, 2};
  EXPECT_FALSE(meet(1)) << "one side alone agrees";
  f.mask = {0, 0};
  EXPECT_FALSE(meet(1));
  f.owner = {0, 0};
  EXPECT_TRUE(meet(2)) << "nobody owns either";
  f.owner = {5, 6};
  EXPECT_TRUE(meet(2));
  f.owner = {5, 5};
  EXPECT_FALSE(meet(2));
  f.motion = {Motion::fixed, Motion::fixed};
  EXPECT_FALSE(meet(4));
  f.motion = {Motion::fixed, Motion::kinematic};
  EXPECT_TRUE(meet(4));
  f.motion = {Motion::kinematic, Motion::kinematic};
  EXPECT_TRUE(meet(4));
}

TEST(FindPairs, InTheCallersRecords) {
  for (const size_t count : {0, 1, 17, 500}) {
    const Boxes boxes = make_boxes(BoxFamily::spoilt, count);
    const std::vector<Pair> expected = plain_pairs(boxes);
    for (const size_t record : {24, 32, 100}) {
      for_each_isa([&] { expect_pairs(boxes, expected, {}, record); });
    }
  }
}

TEST(FindPairs, IntoABuffer) {
  const Boxes boxes = make_boxes(BoxFamily::random, 400);
  const std::vector<Pair> expected = plain_pairs(boxes);
  const LaidOutBoxes memory(boxes);
  const Pair untouched = {123, 456};
  for (const BroadphaseMethod method : kAllMethods) {
    EXPECT_EQ(find_pairs(memory.view(), {}, {}, method), expected.size());

    std::vector<Pair> small(expected.size() - 1, untouched);
    EXPECT_EQ(find_pairs(memory.view(), {}, small, method), expected.size());
    EXPECT_EQ(std::count(small.begin(), small.end(), untouched),
              static_cast<ptrdiff_t>(small.size()));

    GuardedArray exact(expected.size(), sizeof(Pair), sizeof(Pair));
    EXPECT_EQ(find_pairs(memory.view(), {}, {exact.as<Pair>(), expected.size()}, method),
              expected.size());
    EXPECT_TRUE(std::equal(expected.begin(), expected.end(), exact.as<Pair>()));

    std::vector<Pair> large(expected.size() + 5, untouched);
    EXPECT_EQ(find_pairs(memory.view(), {}, large, method), expected.size());
    EXPECT_TRUE(std::equal(expected.begin(), expected.end(), large.begin()));
    EXPECT_EQ(large.back(), untouched);
  }
}

TEST(FindPairs, AreTheSameOnThreads) {
  for (const BoxFamily family : {BoxFamily::random, BoxFamily::lattice, BoxFamily::clustered}) {
    const Boxes boxes = make_boxes(family, 20000);
    const Filters filters(boxes.size(), 1);
    for (const unsigned parts : {0u, 7u}) {
      const PairFilter filter = filters.view(parts);
      const std::vector<Pair> expected = found_pairs(boxes, BroadphaseMethod::sweep, filter);
      EXPECT_GT(expected.size(), 1000u);
      for (const int threads : {1, 2, 4}) {
        ThreadArena arena(threads);
        arena.run([&] {
          for (const BroadphaseMethod method : kAllMethods) {
            EXPECT_TRUE(found_pairs(boxes, method, filter, arena.parallelism()) == expected)
                << name(family) << ", " << carom::name(method) << ", " << threads << " threads";
          }
        });
      }
    }
  }
}

TEST(FindPairs, PermutingTheBoxesPermutesThePairs) {
  Random random(9);
  for (int i = 0; i < kBoxFamilies; ++i) {
    const Boxes boxes = make_boxes(static_cast<BoxFamily>(i), 500);
    std::vector<uint32_t> order(boxes.size());
    std::iota(order.begin(), order.end(), 0);
    for (size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[random.below(k)]);
    Boxes permuted;
    for (const uint32_t body : order) permuted.push_back(boxes[body]);
    for (const BroadphaseMethod method : kAllMethods) {
      std::vector<Pair> back = found_pairs(permuted, method);
      for (Pair& pair : back) {
        const auto [a, b] = std::minmax(order[pair.a], order[pair.b]);
        pair = {a, b};
      }
      std::sort(back.begin(), back.end());
      EXPECT_TRUE(back == found_pairs(boxes, method)) << name(static_cast<BoxFamily>(i));
    }
  }
}

TEST(BroadphaseMethod, Names) {
  EXPECT_STREQ(carom::name(BroadphaseMethod::automatic), "auto");
  EXPECT_STREQ(carom::name(BroadphaseMethod::brute), "brute");
  EXPECT_STREQ(carom::name(BroadphaseMethod::sweep), "sweep");
}

}  // namespace
}  // namespace carom::test
