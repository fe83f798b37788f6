// Every search, on every instruction set, against brute force.
#include "carom/broadphase/find_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <span>

#include "carom/base/thread_arena.h"
#include "tests/support/boxes.h"
#include "tests/support/float_modes.h"
#include "tests/support/isas.h"
#include "tests/support/rounds.h"

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
  // Around the limit of brute force and around one and more blocks of rows.
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

// Around the limits of the automatic choice.
TEST(FindPairs, OfAboutAsManyBoxesAsChangeTheMethod) {
  for (const auto& [count, method] :
       std::initializer_list<std::pair<size_t, BroadphaseMethod>>{{128, BroadphaseMethod::brute},
                                                                  {129, BroadphaseMethod::sweep},
                                                                  {350, BroadphaseMethod::sweep},
                                                                  {351, BroadphaseMethod::grid},
                                                                  {512, BroadphaseMethod::grid}}) {
    const Boxes boxes = make_boxes(BoxFamily::decades, count);
    const LaidOutBoxes memory(boxes);
    std::vector<Pair> pairs;
    const PairSearch search = PairFinder().find(memory.view(), {}, pairs);
    EXPECT_EQ(search.method, method) << count;
    EXPECT_EQ(search.pairs, pairs.size());
    EXPECT_TRUE(search.complete);
    EXPECT_TRUE(pairs == plain_pairs(boxes)) << difference(pairs, plain_pairs(boxes), boxes);
  }
}

// If cells would be crowded, a sweep replaces them, unless the caller asked for cells.
TEST(FindPairs, OfCrowdsFarApart) {
  BoxMaker maker(12);
  Boxes crowds, spread = make_boxes(BoxFamily::random, 4000);
  for (size_t i = 0; i < spread.size(); ++i) {
    crowds.push_back(maker.in_cube(20, 0.5));
    for (int axis = 0; axis < 3; ++axis) {
      const float far = 1e5f * static_cast<float>(i % 4);
      crowds[i].lower[axis] += far;
      crowds[i].upper[axis] += far;
    }
  }
  const std::vector<Pair> crowds_expected = plain_pairs(crowds);
  const std::vector<Pair> spread_expected = plain_pairs(spread);
  PairFinder automatic, cells;
  size_t sweeps = 0;
  for (int frame = 0; frame < 24; ++frame) {
    const bool crowded = frame / 6 % 2 == 0;
    const Boxes& boxes = crowded ? crowds : spread;
    const std::vector<Pair>& expected = crowded ? crowds_expected : spread_expected;
    const LaidOutBoxes memory(boxes);
    std::vector<Pair> pairs;
    const PairSearch search = automatic.find(memory.view(), {}, pairs);
    EXPECT_TRUE(pairs == expected) << frame << ": " << difference(pairs, expected, boxes);
    EXPECT_EQ(search.grids == 0, search.method == BroadphaseMethod::sweep);
    sweeps += search.method == BroadphaseMethod::sweep;
    EXPECT_EQ(cells.find(memory.view(), {}, pairs, BroadphaseMethod::grid).method,
              BroadphaseMethod::grid);
    EXPECT_TRUE(pairs == expected) << frame << ": " << difference(pairs, expected, boxes);
  }
  EXPECT_EQ(sweeps, 12u);
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

// Flush-to-zero and other rounding modes of the caller change nothing.
TEST(FindPairs, InAnyFloatMode) {
  for (const BoxFamily family : {BoxFamily::subnormal, BoxFamily::lattice, BoxFamily::any_bits}) {
    for (const size_t count : {40, 300}) {
      const Boxes boxes = make_boxes(family, count);
      const std::vector<Pair> expected = plain_pairs(boxes);
      for (const FloatMode& mode : float_modes()) {
        for (const BroadphaseMethod method : kAllMethods) {
          PairFinder finder;
          for (int repeat = 0; repeat < 2; ++repeat) {  // sorted from scratch, then repaired
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

// Both boxes have subnormal coordinates, and the second box is inverted.
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
  constexpr int kThreadCounts[] = {4, 2, 1};
  for (const BoxFamily family : {BoxFamily::random, BoxFamily::lattice, BoxFamily::clustered}) {
    const Boxes boxes = make_boxes(family, 20000);
    const Filters filters(boxes.size(), 1);
    for (const unsigned parts : {0u, 7u}) {
      const PairFilter filter = filters.view(parts);
      const std::vector<Pair> expected = found_pairs(boxes, BroadphaseMethod::sweep, filter);
      EXPECT_GT(expected.size(), 1000u);
      for (const int threads : std::span(kThreadCounts).first(rounds(3))) {
        ThreadArena arena(threads);
        arena.run([&] {
          for (const BroadphaseMethod method : kAllMethods) {
            // Brute force takes as long as all else: of one family.
            if (method == BroadphaseMethod::brute && family != BoxFamily::random) continue;
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

// Coordinates have so few bits that no sum is rounded.
TEST(FindPairs, MovingTheWholeWorldChangesNothing) {
  Random random(10);
  for (const size_t count : {100, 700, 5000}) {
    Boxes boxes(count);
    for (TestBox& box : boxes) {
      for (int axis = 0; axis < 3; ++axis) {
        const uint64_t extent = static_cast<uint64_t>(16 * side_for(count));
        box.lower[axis] = static_cast<float>(random.below(extent)) / 16;
        box.upper[axis] = box.lower[axis] + static_cast<float>(random.below(25)) / 16;
      }
    }
    const std::vector<Pair> expected = plain_pairs(boxes);
    PairFinder finder;
    for (int power = -4; power <= 14; power += 2) {
      for (const int axis : {0, 1, 2}) {
        for (const float way : {std::ldexp(1.0f, power), -std::ldexp(1.0f, power + 1)}) {
          for (TestBox& box : boxes) {
            box.lower[axis] += way;
            box.upper[axis] += way;
          }
          for (const BroadphaseMethod method : {BroadphaseMethod::sweep, BroadphaseMethod::grid}) {
            ASSERT_TRUE(found_pairs(finder, boxes, method) == expected)
                << count << " boxes, " << carom::name(method);
          }
        }
      }
    }
  }
}

// Powers of two scale boxes without rounding, from tiny to huge.
TEST(FindPairs, ScalingTheWholeWorldChangesNothing) {
  for (const BoxFamily family : {BoxFamily::lattice, BoxFamily::random, BoxFamily::decades}) {
    const Boxes boxes = make_boxes(family, 800);
    const std::vector<Pair> expected = plain_pairs(boxes);
    for (const int power : {-90, -60, -20, -1, 1, 10, 60, 120}) {
      Boxes scaled = boxes;
      for (TestBox& box : scaled) {
        for (int axis = 0; axis < 3; ++axis) {
          box.lower[axis] = std::ldexp(box.lower[axis], power);
          box.upper[axis] = std::ldexp(box.upper[axis], power);
        }
      }
      for (const BroadphaseMethod method : {BroadphaseMethod::sweep, BroadphaseMethod::grid}) {
        EXPECT_TRUE(found_pairs(scaled, method) == expected)
            << name(family) << " times 2^" << power << ", " << carom::name(method);
      }
    }
  }
}

TEST(BroadphaseMethod, Names) {
  EXPECT_STREQ(carom::name(BroadphaseMethod::automatic), "auto");
  EXPECT_STREQ(carom::name(BroadphaseMethod::brute), "brute");
  EXPECT_STREQ(carom::name(BroadphaseMethod::sweep), "sweep");
  EXPECT_STREQ(carom::name(BroadphaseMethod::grid), "grid");
}

}  // namespace
}  // namespace carom::test
