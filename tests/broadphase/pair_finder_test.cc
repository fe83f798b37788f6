// A finder that is used again and again finds the same pairs as a new one.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <iterator>

#include "broadphase/sweep/sweep_order.h"
#include "carom/base/thread_arena.h"
#include "tests/support/boxes.h"
#include "tests/support/isas.h"

namespace carom::test {
namespace {

// Boxes that drift, jump, appear and disappear.
class Crowd {
 public:
  Crowd(size_t count, uint64_t seed) : maker_(seed), boxes_(make_boxes(BoxFamily::random, count)) {}

  const Boxes& boxes() const { return boxes_; }

  void drift(double distance) {
    for (TestBox& box : boxes_) move(box, distance);
  }

  void jump(double share) {
    for (TestBox& box : boxes_) {
      if (maker_.random().chance(share)) box = maker_.in_cube(side_for(boxes_.size()));
    }
  }

  void appear(size_t count) {
    for (size_t i = 0; i < count; ++i) boxes_.push_back(maker_.in_cube(side_for(boxes_.size())));
  }

  void shrink(size_t count) { boxes_.resize(boxes_.size() - std::min(count, boxes_.size())); }

  // Some boxes become empty or NaN, others become valid again.
  void spoil(double share) {
    for (TestBox& box : boxes_) {
      if (!maker_.random().chance(share)) continue;
      box = maker_.random().chance(0.5) ? maker_.spoilt(box)
                                        : maker_.in_cube(side_for(boxes_.size()));
    }
  }

  // Replaces one box by another; the count stays.
  void replace() {
    if (boxes_.size() < 2) return;
    TestBox& out = boxes_[maker_.random().below(boxes_.size())];
    out = {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
    boxes_[maker_.random().below(boxes_.size())] = maker_.in_cube(side_for(boxes_.size()));
  }

  // Stretches the world along an axis, so that the axis of largest spread changes.
  void stretch(int axis) {
    for (TestBox& box : boxes_) {
      box.lower[axis] *= 4;
      box.upper[axis] *= 4;
    }
  }

 private:
  void move(TestBox& box, double distance) {
    for (int i = 0; i < 3; ++i) {
      const float way = maker_.uniform(-distance, distance);
      box.lower[i] += way;
      box.upper[i] += way;
    }
  }

  BoxMaker maker_;
  Boxes boxes_;
};

void expect_as_if_new(PairFinder& finder, const Boxes& boxes, BroadphaseMethod method,
                      Parallelism parallelism = Parallelism::none) {
  const std::vector<Pair> got = found_pairs(finder, boxes, method, {}, parallelism);
  const std::vector<Pair> expected = plain_pairs(boxes);
  ASSERT_TRUE(got == expected) << difference(got, expected, boxes);
}

TEST(PairFinder, RepairsItsOrder) {
  for (const double distance : {0.0, 1e-3, 0.05, 0.5, 5.0}) {
    Crowd crowd(400, 1);
    PairFinder finder;
    for (int frame = 0; frame < 60; ++frame) {
      if (frame % 10 == 3) crowd.replace();
      if (frame % 10 == 5) crowd.appear(3);
      if (frame % 10 == 7) crowd.shrink(4);
      if (frame % 20 == 9) crowd.stretch(frame / 20);
      crowd.drift(distance);
      expect_as_if_new(finder, crowd.boxes(), BroadphaseMethod::sweep);
    }
  }
}

RC_GTEST_PROP(PairFinder, ForgetsNothingAndRemembersNothing,
              (const std::vector<uint8_t>& changes, uint64_t seed)) {
  Crowd crowd(seed % 200, seed);
  PairFinder finder;
  for (const uint8_t change : changes) {
    switch (change % 10) {
      case 0:
        crowd.drift(0.01);
        break;
      case 1:
        crowd.drift(2);
        break;
      case 2:
        crowd.jump(0.1);
        break;
      case 3:
        crowd.appear(change);
        break;
      case 4:
        crowd.shrink(change);
        break;
      case 5:
        crowd.spoil(0.2);
        break;
      case 6:
        crowd.replace();
        break;
      case 7:
        crowd.stretch(change % 3);
        break;
      case 8:
        finder.forget();
        break;
      default:
        finder = PairFinder(std::move(finder));
    }
    const BroadphaseMethod method = kAllMethods[change / 10 % 4];
    RC_ASSERT(found_pairs(finder, crowd.boxes(), method) == plain_pairs(crowd.boxes()));
  }
}

TEST(PairFinder, IsTheSameOnThreadsOverManyFrames) {
  Crowd crowd(20000, 2);
  ThreadArena arena(4);
  arena.run([&] {
    PairFinder one, four;
    for (int frame = 0; frame < 8; ++frame) {
      crowd.drift(frame % 3 == 2 ? 3 : 0.02);
      if (frame == 4) crowd.appear(100);
      EXPECT_TRUE(
          found_pairs(one, crowd.boxes(), BroadphaseMethod::sweep) ==
          found_pairs(four, crowd.boxes(), BroadphaseMethod::sweep, {}, Parallelism::arena));
    }
  });
}

// The pairs of a crowd that drifts, in any order, one frame behind the other.
std::vector<Pair> pairs_in_any_order(size_t boxes, BroadphaseMethod method,
                                     Parallelism parallelism) {
  PairFinder finder;
  finder.set_order(PairOrder::any);
  Crowd crowd(boxes, 1);
  std::vector<Pair> all;
  for (int frame = 0; frame < 4; ++frame) {
    std::vector<Pair> pairs = found_pairs(finder, crowd.boxes(), method, {}, parallelism);
    all.insert(all.end(), pairs.begin(), pairs.end());
    std::ranges::sort(pairs);
    EXPECT_EQ(pairs, plain_pairs(crowd.boxes()));
    crowd.drift(0.1);
  }
  return all;
}

TEST(PairFinder, GivesPairsInAnyOrderIfThatIsWanted) {
  for (const size_t boxes : {0u, 1u, 2u, 60u, 300u, 900u}) {
    for (const BroadphaseMethod method : kAllMethods) {
      const std::vector<Pair> pairs = pairs_in_any_order(boxes, method, Parallelism::none);
      EXPECT_TRUE(std::ranges::all_of(pairs, [](Pair pair) { return pair.a < pair.b; }));
      ThreadArena arena(4);
      arena.run([&] { EXPECT_EQ(pairs_in_any_order(boxes, method, arena.parallelism()), pairs); });
      for_each_isa([&] { EXPECT_EQ(pairs_in_any_order(boxes, method, Parallelism::none), pairs); });
    }
  }
}

TEST(PairFinder, SortsPairsOfWhichSomeAreExcluded) {
  PairFinder finder;
  finder.set_order(PairOrder::any);
  const Crowd crowd(3000, 1);
  const std::vector<Pair> all = plain_pairs(crowd.boxes());
  const std::vector<Pair> excluded = {all[1], all[all.size() / 2]};
  std::vector<Pair> expected;
  std::ranges::set_difference(all, excluded, std::back_inserter(expected));
  for (int frame = 0; frame < 3; ++frame) {
    EXPECT_EQ(found_pairs(finder, crowd.boxes(), BroadphaseMethod::grid, {.excluded = excluded}),
              expected);
    std::vector<Pair> any = found_pairs(finder, crowd.boxes(), BroadphaseMethod::grid);
    std::ranges::sort(any);
    EXPECT_EQ(any, all);
  }
}

TEST(PairFinder, SaysWhichMethodRanAndWhy) {
  const auto search = [](size_t count, BroadphaseMethod method) {
    const LaidOutBoxes memory(make_boxes(BoxFamily::random, count));
    std::vector<Pair> pairs;
    return PairFinder().find(memory.view(), {}, pairs, method);
  };
  EXPECT_EQ(search(10, BroadphaseMethod::automatic).method, BroadphaseMethod::brute);
  EXPECT_EQ(search(300, BroadphaseMethod::automatic).method, BroadphaseMethod::sweep);
  EXPECT_EQ(search(2000, BroadphaseMethod::automatic).method, BroadphaseMethod::grid);
  EXPECT_STREQ(search(10, BroadphaseMethod::automatic).reason, "at most 128 boxes");
  for (const BroadphaseMethod method :
       {BroadphaseMethod::brute, BroadphaseMethod::sweep, BroadphaseMethod::grid}) {
    EXPECT_EQ(search(10, method).method, method);
    EXPECT_EQ(search(1000, method).method, method);
    EXPECT_STREQ(search(10, method).reason, "asked for");
  }
}

TEST(PairFinder, KeepsItsMemory) {
  PairFinder finder;
  const size_t none = finder.bytes();
  const Boxes boxes = make_boxes(BoxFamily::random, 1000);
  found_pairs(finder, boxes, BroadphaseMethod::sweep);
  const size_t used = finder.bytes();
  EXPECT_GT(used, none + 1000 * sizeof(TestBox));
  for (int repeat = 0; repeat < 3; ++repeat) {
    found_pairs(finder, boxes, BroadphaseMethod::sweep);
    EXPECT_EQ(finder.bytes(), used);
  }
  finder.forget();
  EXPECT_EQ(finder.bytes(), used);
  expect_as_if_new(finder, boxes, BroadphaseMethod::sweep);
}

// Lists that grow now and then wait for the system in a frame that takes no longer than others
// else.
TEST(PairFinder, NeedsNoMoreMemoryWhereAFewPairsComeAndGo) {
  for (const BroadphaseMethod method : {BroadphaseMethod::grid, BroadphaseMethod::sweep}) {
    PairFinder finder;
    Crowd crowd(5000, 8);
    size_t used = 0;
    for (int frame = 0; frame < 40; ++frame) {
      crowd.drift(0.01);
      ASSERT_GT(found_pairs(finder, crowd.boxes(), method).size(), 1000u);
      if (frame >= 5) {
        ASSERT_EQ(finder.bytes(), used) << "frame " << frame;
      }
      used = finder.bytes();
    }
  }
}

TEST(PairFinder, HoldsNoMoreAfterManySearchesThatFindTooMuch) {
  const Boxes boxes(3000, TestBox{{0, 0, 0}, {1, 1, 1}});
  for (const BroadphaseMethod method : {BroadphaseMethod::grid, BroadphaseMethod::sweep}) {
    PairFinder finder;
    finder.set_most_pairs(1000);
    std::vector<Pair> pairs;
    const auto search = [&] {
      const LaidOutBoxes memory(boxes);
      EXPECT_FALSE(finder.find(memory.view(), {}, pairs, method, Parallelism::none).complete);
      return finder.bytes();
    };
    size_t used = 0;
    for (int i = 0; i < 3; ++i)
      used = search();  // boxes that rest are remembered from the second on
    for (int i = 0; i < 20; ++i) ASSERT_LE(search(), used) << i;
  }
}

// A box more or less does not change the number of tasks, whose lists would all grow.
TEST(PairFinder, ABoxMoreOrLessTakesNoOtherLists) {
  PairFinder finder;
  Crowd crowd(20033, 9);
  for (int frame = 0; frame < 3; ++frame)
    found_pairs(finder, crowd.boxes(), BroadphaseMethod::grid);
  const size_t used = finder.bytes();
  for (int box = 0; box < 3; ++box) {
    crowd.shrink(1);
    found_pairs(finder, crowd.boxes(), BroadphaseMethod::grid);
    EXPECT_EQ(finder.bytes(), used);
  }
}

// --- The axis and the order ---

TEST(SweepOrder, IsByLowerCornerThenIndex) {
  SweepOrder sweep;
  std::vector<uint32_t> order;
  Crowd crowd(300, 3);
  for (int frame = 0; frame < 30; ++frame) {
    if (frame % 3 == 0) crowd.spoil(0.1);
    if (frame % 5 == 1) crowd.appear(5);
    crowd.drift(0.1);
    Boxes boxes = crowd.boxes();
    for (TestBox& box : boxes) {
      if (frame % 2 == 0) box.lower[0] = std::floor(box.lower[0]);  // ties
      if (box.lower[0] == 0 && frame % 4 == 0) box.lower[0] = -0.0f;
    }
    const LaidOutBoxes memory(boxes);
    sweep.update(memory.view(), 0, Parallelism::none, order);

    std::vector<uint32_t> expected;
    for (uint32_t i = 0; i < boxes.size(); ++i) {
      if (overlap(boxes[i], boxes[i])) expected.push_back(i);
    }
    std::stable_sort(expected.begin(), expected.end(),
                     [&](uint32_t x, uint32_t y) { return boxes[x].lower[0] < boxes[y].lower[0]; });
    ASSERT_EQ(order, expected) << "frame " << frame;
  }
}

TEST(SweepOrder, AxisOfLargestSpread) {
  const auto axis_of = [](const Boxes& boxes) {
    return axis_of_largest_spread(LaidOutBoxes(boxes).view());
  };
  EXPECT_EQ(axis_of({}), 0u);
  for (int axis = 0; axis < 3; ++axis) {
    for (const size_t count : {2, 300, 9000}) {
      Boxes boxes = make_boxes(BoxFamily::random, count);
      for (TestBox& box : boxes) {
        box.lower[axis] *= 100;
        box.upper[axis] *= 100;
      }
      EXPECT_EQ(axis_of(boxes), static_cast<size_t>(axis));
    }
  }
  // Among equal axes the first wins. Infinite boxes and boxes that take no part do not count.
  EXPECT_EQ(axis_of({{{0, 0, 0}, {1, 1, 1}}, {{1, 1, 1}, {2, 2, 2}}}), 0u);
  EXPECT_EQ(axis_of({{{0, 0, 0}, {1, 1, 1}}, {{0, 2, 1}, {1, 9, 9}}, {{kNan, 0, 99}, {0, 0, 99}}}),
            1u);
  EXPECT_EQ(axis_of({{{-kInfinity, 0, 0}, {1, 1, 1}}, {{-kInfinity, 0, 1}, {1, 9, 9}}}), 2u);
}

}  // namespace
}  // namespace carom::test
