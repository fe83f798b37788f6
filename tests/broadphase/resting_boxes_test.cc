// Histories: a finder that keeps resting boxes finds the same pairs as a plain search, frame after
// frame.
#include "broadphase/resting/resting_boxes.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "carom/base/thread_arena.h"
#include "tests/broadphase/box_histories.h"
#include "tests/support/boxes.h"
#include "tests/support/isas.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

// Runs a history and compares every frame; false after a failure.
bool run_history(uint64_t seed, size_t most_boxes, int frames, Parallelism parallelism,
                 BoxCoverage& coverage) {
  Random random(seed);
  const auto family = static_cast<BoxFamily>(random.below(kBoxFamilies));
  BoxHistory history(seed, random.below(most_boxes), family);
  for (int frame = 0; frame < frames; ++frame) {
    if (frame > 2) history.step(random.bits());
    const std::vector<Pair> got = history.find(parallelism);
    const std::vector<Pair> expected = plain_pairs(history.boxes(), history.filter());
    if (got != expected) {
      ADD_FAILURE() << "seed " << seed << ", frame " << frame << ", " << name(family) << ", "
                    << difference(got, expected, history.boxes());
      return false;
    }
  }
  coverage = coverage + history.coverage();
  return true;
}

void expect_covered(const BoxCoverage& coverage, size_t least) {
  EXPECT_GT(coverage.pairs, coverage.frames);
  EXPECT_GE(coverage.rested, least);
  EXPECT_GE(coverage.woke, least);
  EXPECT_GE(coverage.idle, least);
  EXPECT_GE(coverage.settled, least);
  EXPECT_GE(coverage.settled_again, least);
  EXPECT_GE(coverage.restless, least);
  EXPECT_GE(coverage.shrank, least);
  EXPECT_GE(coverage.filtered, least);
  EXPECT_GE(coverage.told, least);
  EXPECT_GE(coverage.unsorted, least);
  for (const auto& [what, times] : std::initializer_list<std::pair<const char*, size_t>>{
           {"frames", coverage.frames},
           {"rested", coverage.rested},
           {"woke", coverage.woke},
           {"idle", coverage.idle},
           {"settled", coverage.settled},
           {"settled_again", coverage.settled_again},
           {"restless", coverage.restless},
           {"shrank", coverage.shrank},
           {"filtered", coverage.filtered},
           {"told", coverage.told},
           {"unsorted", coverage.unsorted}}) {
    testing::Test::RecordProperty(what, std::to_string(times));
  }
}

TEST(RestingBoxes, ThroughThousandsOfHistories) {
  BoxCoverage coverage;
  for (uint64_t seed = 0; seed < rounds(4000); ++seed) {
    ASSERT_TRUE(run_history(seed, seed % 10 == 0 ? 200 : 50, 30, Parallelism::none, coverage));
  }
  expect_covered(coverage, rounds(2000));
}

TEST(RestingBoxes, OnEveryInstructionSet) {
  for_each_isa([] {
    BoxCoverage coverage;
    for (uint64_t seed = 5000; seed < 5200; ++seed) {
      ASSERT_TRUE(run_history(seed, 90, 30, Parallelism::none, coverage));
    }
    expect_covered(coverage, 40);
  });
}

TEST(RestingBoxes, OnSeveralThreads) {
  ThreadArena arena(4);
  arena.run([&] {
    BoxCoverage coverage;
    for (uint64_t seed = 0; seed < rounds(100, 12); ++seed) {
      ASSERT_TRUE(run_history(6000 + seed, 600, 20, arena.parallelism(), coverage));
    }
    expect_covered(coverage, rounds(20, 4));
  });
}

// The same for RapidCheck, which reduces a failing history to the steps that matter.
RC_GTEST_PROP(RestingBoxes, ThroughAnyHistory,
              (const std::vector<uint8_t>& steps, uint64_t seed, uint8_t boxes)) {
  BoxHistory history(seed, boxes % 64, static_cast<BoxFamily>(seed % kBoxFamilies));
  for (const uint8_t step : steps) {
    history.step(step);
    RC_ASSERT(history.find() == plain_pairs(history.boxes(), history.filter()));
  }
}

// --- Cases that random histories do not reach ---

// A lattice of boxes that do not touch, and a finder that knows them as resting.
class Lattice {
 public:
  explicit Lattice(size_t side) {
    for (size_t i = 0; i < side * side * side; ++i) {
      TestBox box;
      const size_t at[3] = {i % side, i / side % side, i / (side * side)};
      for (int axis = 0; axis < 3; ++axis) {
        box.lower[axis] = 2 * static_cast<float>(at[axis]);
        box.upper[axis] = box.lower[axis] + 1;
      }
      boxes.push_back(box);
    }
    for (int repeat = 0; repeat < 3; ++repeat) find();
  }

  std::vector<Pair> find(const PairFilter& filter = {}) {
    const LaidOutBoxes memory(boxes);
    std::vector<Pair> pairs;
    search = finder.find(memory.view(), filter, pairs, BroadphaseMethod::grid);
    return pairs;
  }

  Boxes boxes;
  PairFinder finder;
  PairSearch search;
};

// A box that stopped resting is gone from its old place: not even an infinite box meets it there.
TEST(RestingBoxes, ThatLeftMeetNothingWhereTheyWere) {
  for (const TestBox& where : {kEverywhere, kEmpty, TestBox{{0, 0, 0}, {40, 40, 40}}}) {
    Lattice world(6);
    world.boxes[10] = where;
    EXPECT_TRUE(world.find() == plain_pairs(world.boxes));
    world.boxes[20] = kEverywhere;
    EXPECT_TRUE(world.find() == plain_pairs(world.boxes));
    world.boxes[30].lower[1] = kNan;
    EXPECT_TRUE(world.find() == plain_pairs(world.boxes));
    world.boxes.resize(200);
    EXPECT_TRUE(world.find() == plain_pairs(world.boxes));
    EXPECT_LT(world.search.searched, 10u) << "the others rest";
  }
}

// Boxes that reach hundreds of rows of cells, among others that reach a few, with and without a
// filter.
TEST(RestingBoxes, MeetLargeBoxesThatMove) {
  const auto run = [](const PairFilter& filter) {
    Lattice world(12);
    for (int frame = 0; frame < 3; ++frame) world.find(filter);
    for (size_t frame = 0; frame < 5; ++frame) {
      for (size_t i = 0; i < 60; ++i) {
        const bool is_large = i % 7 == frame;
        TestBox& box = world.boxes[i * 25 + 3];
        for (size_t axis = 0; axis < 3; ++axis) {
          box.lower[axis] = is_large ? -1 : static_cast<float>((i * (axis + 3) + frame) % 22);
          box.upper[axis] = is_large ? static_cast<float>(axis + 20) : box.lower[axis] + 1.5f;
        }
      }
      const std::vector<Pair> found = world.find(filter);
      EXPECT_TRUE(found == plain_pairs(world.boxes, filter));
      EXPECT_GT(found.size(), 1000u);
      EXPECT_EQ(world.search.searched, 60u) << "the others rest";
    }
  };
  const Filters filters(12 * 12 * 12, 3);
  for_each_isa([&] {
    run({});
    run(filters.view(2));
  });
}

TEST(RestingBoxes, AreAllSearchedForUntilTheyRest) {
  const Boxes boxes = make_boxes(BoxFamily::random, 700);
  const LaidOutBoxes memory(boxes);
  PairFinder finder;
  std::vector<Pair> pairs;
  std::vector<size_t> searched;
  for (int frame = 0; frame < 4; ++frame) {
    searched.push_back(finder.find(memory.view(), {}, pairs).searched);
  }
  EXPECT_EQ(searched, (std::vector<size_t>{700, 700, 0, 0}));
}

TEST(RestingBoxes, AreSearchedForOnlyIfTheyChange) {
  Lattice world(8);
  world.find();
  EXPECT_EQ(world.search.changed, 0u);
  EXPECT_EQ(world.search.searched, 0u);
  world.boxes[100].upper[0] += 0.5f;
  world.boxes[7].lower[0] = -0.5f;
  world.find();
  EXPECT_EQ(world.search.changed, 2u);
  EXPECT_EQ(world.search.searched, 2u);
  world.find();
  EXPECT_EQ(world.search.changed, 0u);
  EXPECT_EQ(world.search.searched, 2u) << "they have not settled yet";
  size_t from_scratch = 0;
  for (int frame = 0; frame < 300; ++frame) {
    world.find();
    from_scratch += world.search.searched == world.boxes.size();
  }
  EXPECT_EQ(world.search.searched, 0u) << "now they have";
  EXPECT_EQ(from_scratch, 1u);
}

// If too many boxes move, the finder starts anew each frame, and keeps pairs again once most boxes
// rest.
TEST(RestingBoxes, AreForgottenWhileMostBoxesMove) {
  Lattice world(8);
  for (int frame = 0; frame < 4; ++frame) {
    for (TestBox& box : world.boxes) box.upper[1] += 0.4f;
    EXPECT_TRUE(world.find() == plain_pairs(world.boxes));
    EXPECT_EQ(world.search.searched, world.boxes.size());
  }
  for (int frame = 0; frame < 3; ++frame) EXPECT_TRUE(world.find() == plain_pairs(world.boxes));
  EXPECT_EQ(world.search.searched, 0u);
}

// The filter belongs to the resting state: a box whose filter changed is searched again.
TEST(RestingBoxes, MeetOthersWhenTheirFilterChanges) {
  Lattice world(6);
  for (TestBox& box : world.boxes) box.upper[0] += 1;  // now neighbours touch
  Filters filters(world.boxes.size(), 1);
  std::fill(filters.owner.begin(), filters.owner.end(), 1u);
  const PairFilter filter = filters.view(2);
  for (int frame = 0; frame < 4; ++frame) EXPECT_TRUE(world.find(filter).empty());
  filters.owner[43] = 2;
  EXPECT_TRUE(world.find(filter) == plain_pairs(world.boxes, filter));
  EXPECT_EQ(world.search.pairs, 2u);
  EXPECT_EQ(world.search.changed, 1u);
  filters.owner[43] = 1;
  EXPECT_TRUE(world.find(filter).empty());
  EXPECT_TRUE(world.find() == plain_pairs(world.boxes)) << "without a filter";
  EXPECT_TRUE(world.find(filter).empty());
}

TEST(RestingBoxes, InALargeWorldOnOneThreadAndFour) {
  constexpr uint32_t kFrames = rounds(30, 12);
  BoxMaker maker(11);
  Random& random = maker.random();
  for (const BoxFamily family : {BoxFamily::random, BoxFamily::decades}) {
    Boxes boxes = make_boxes(family, 20000);
    ThreadArena arena(4);
    arena.run([&] {
      PairFinder one, four, sweep;
      size_t kept = 0;
      for (uint32_t frame = 0; frame < kFrames; ++frame) {
        for (size_t i = 0; i < boxes.size() / 100; ++i) {
          const size_t body = frame < kFrames * 2 / 3 ? i * 97 : random.below(boxes.size());
          boxes[body] = make_box(family, maker, body, boxes.size());
        }
        const LaidOutBoxes memory(boxes);
        std::vector<Pair> a, b, expected;
        sweep.find(memory.view(), {}, expected, BroadphaseMethod::sweep);
        const PairSearch search = one.find(memory.view(), {}, a, BroadphaseMethod::grid);
        four.find(memory.view(), {}, b, BroadphaseMethod::grid, arena.parallelism());
        ASSERT_TRUE(a == expected) << name(family) << ", frame " << frame;
        ASSERT_TRUE(b == expected) << name(family) << ", frame " << frame << ", four threads";
        kept += search.searched < boxes.size() / 4 && search.changed < boxes.size();
      }
      EXPECT_GE(kept, kFrames - 5);
    });
  }
}

}  // namespace
}  // namespace carom::test
