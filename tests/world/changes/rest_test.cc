// Worlds at rest at detail pairs: when a step compares bodies with the last step, and that this
// affects only the time.
#include "world/changes/rest_watch.h"

#include <gtest/gtest.h>

#include <functional>

#include "tests/support/rounds.h"
#include "tests/world/crowds.h"

namespace carom::test {
namespace {

// Sizes for brute force, for a sweep, and for cells.
constexpr size_t kCounts[] = {100, 400, 3000};

CrowdSpec crowd_of(size_t count) {
  return {.count = count, .side = std::cbrt(static_cast<double>(count)), .filters = true};
}

WorldSettings pairs_only() { return {.detail = Detail::pairs}; }

bool searches(World& world) { return world.step().ran(Stage::broadphase); }

// Steps until the world counts as resting; returns the number of steps.
int settle(World& world) {
  for (int steps = 1; steps < 200; ++steps) {
    if (!searches(world)) return steps;
  }
  ADD_FAILURE() << "never at rest";
  return 0;
}

TEST(Rest, AStillWorldStopsSearching) {
  for (const size_t count : kCounts) {
    World world(pairs_only());
    add_crowd(world, crowd_of(count));
    EXPECT_LE(settle(world), 8);
    const std::string pairs = as_bytes(world.pairs());
    EXPECT_FALSE(pairs.empty());
    for (int i = 0; i < 5; ++i) {
      const StepReport& report = world.step();
      EXPECT_EQ(report.stages_run, 1u << static_cast<int>(Stage::changes));
      EXPECT_EQ(report.pairs * sizeof(Pair), pairs.size());
      EXPECT_EQ(as_bytes(world.pairs()), pairs);
    }
  }
}

TEST(Rest, WhateverIsDoneToABodyIsSeen) {
  const std::function<void(World&, BodyId)> changes[] = {
      [](World& w, BodyId id) { w.set_position(id, w.position(id) + Eigen::Vector3d(1, 0, 0)); },
      [](World& w, BodyId id) { w.arrays().record32[4 * id.index] += 1; },
      [](World& w, BodyId id) {
        w.set_position(id, {std::nan(""), 0, 0});
      },
      [](World& w, BodyId id) { w.set_shape(id, Sphere{2}); },
      [](World& w, BodyId id) { w.set_shape(id, Sphere{-1}); },
      [](World& w, BodyId id) { w.set_shape(id, Halfspace{}); },
      [](World& w, BodyId id) {
        w.set_shape(id, Box{{1, 2, 0.1f}});
      },
      [](World& w, BodyId id) { w.set_filter(id, 0, 0, 0); },
      [](World& w, BodyId id) { w.set_motion(id, Motion::fixed); },
      [](World& w, BodyId id) { w.remove(id); },
      [](World& w, BodyId) {
        w.add({.shape = Sphere{2}, .position = {1, 1, 1}});
      },
  };
  for (const size_t count : kCounts) {
    for (const auto& change : changes) {
      World resting(pairs_only()), fresh({.detail = Detail::pairs, .carry_results = false});
      const BodyId id = add_crowd(resting, crowd_of(count))[count / 2];
      add_crowd(fresh, crowd_of(count));
      settle(resting);
      for (World* world : {&resting, &fresh}) {
        change(*world, id);
        EXPECT_TRUE(searches(*world));
      }
      EXPECT_TRUE(results(resting) == results(fresh));
      settle(resting);
      EXPECT_TRUE(results(resting) == results(fresh));
      EXPECT_EQ(resting.report().quarantined, fresh.report().quarantined);
    }
  }
}

TEST(Rest, WhatIsWrittenToOrientationsAndRowsIsSeen) {
  const std::function<void(World&, BodyId)> changes[] = {
      [](World& w, BodyId id) {
        w.set_orientation(id, {1, 2, 3, 4});
      },
      [](World& w, BodyId id) { w.arrays().orientation[4 * id.index + 1] += 1; },
      [](World& w, BodyId id) { w.arrays().orientation[4 * id.index + 1] = std::nanf(""); },
      [](World& w, BodyId id) { w.shape_rows().rows[4 * w.first_row(id)] += 1; },
  };
  for (const size_t count : kCounts) {
    for (const auto& change : changes) {
      for (const Shape& shape : {Shape(Box{{1, 0.5f, 2}}), Shape(Halfspace{{1, 2, 0}, 0})}) {
        World resting(pairs_only()), fresh({.detail = Detail::pairs, .carry_results = false});
        CrowdSpec spec = crowd_of(count);
        spec.oriented = true;
        const BodyId id = add_crowd(resting, spec)[count / 2];
        add_crowd(fresh, spec);
        for (World* world : {&resting, &fresh}) world->set_shape(id, shape);
        settle(resting);
        for (World* world : {&resting, &fresh}) {
          change(*world, id);
          EXPECT_TRUE(searches(*world));
        }
        EXPECT_TRUE(results(resting) == results(fresh));
        settle(resting);
        EXPECT_TRUE(results(resting) == results(fresh));
      }
    }
  }
}

TEST(Rest, BodiesThatAllMoveAreNeverCompared) {
  for (const size_t count : kCounts) {
    World world(pairs_only());
    const std::vector<BodyId> ids = add_crowd(world, crowd_of(count));
    Random random(1);
    for (int i = 0; i < 50; ++i) {
      EXPECT_FALSE(world.step().ran(Stage::changes));
      move_some(world, ids, 1, random);
    }
  }
}

TEST(Rest, OneThatMovesAmongManyIsSeldomCompared) {
  for (const size_t count : kCounts) {
    World world(pairs_only());
    const std::vector<BodyId> ids = add_crowd(world, crowd_of(count));
    int compared = 0;
    for (int i = 0; i < 200; ++i) {
      compared += world.step().ran(Stage::changes);
      world.set_position(ids[7], {i * 0.1, 0, 0});
    }
    EXPECT_LE(compared, 12);
  }
}

TEST(Rest, NothingIsKeptIfNothingIsCarried) {
  World world({.detail = Detail::pairs, .carry_results = false});
  add_crowd(world, crowd_of(3000));
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(searches(world));
}

TEST(Rest, RandomHistories) {
  const uint32_t histories = rounds(60, 6);
  uint32_t still = 0;
  for (uint64_t seed = 0; seed < histories; ++seed) {
    Random random(seed);
    const CrowdSpec crowd = crowd_of(kCounts[seed % 3]);
    const float margin = seed % 2 ? 0.1f : 0.0f;
    World resting({.detail = Detail::pairs, .margin = margin});
    World fresh({.detail = Detail::pairs, .carry_results = false, .margin = margin});
    const std::vector<BodyId> ids = add_crowd(resting, crowd);
    add_crowd(fresh, crowd);
    bool moves = false;
    for (int i = 0; i < 60; ++i) {
      if (random.chance(0.1)) moves = !moves;
      const double share = random.chance(0.5) ? 1 : 0.001;
      Random same(i), again(i);
      if (moves) {
        move_some(resting, ids, share, same);
        move_some(fresh, ids, share, again);
      }
      still += !searches(resting);
      fresh.step();
      ASSERT_TRUE(results(resting) == results(fresh)) << seed << ' ' << i;
    }
  }
  EXPECT_GT(still, 5 * histories);
}

TEST(RestWatch, WaitsLongerEachTimeItWasWrong) {
  RestWatch watch;
  int last_waited = 0;
  for (int i = 0; i < 10; ++i) {
    int waited = 0;
    for (; !watch.is_on(); ++waited) watch.saw_step(true);
    EXPECT_GE(waited, std::min(2 * last_waited, 64));
    last_waited = waited;
    watch.saw_step(true);  // makes the copy
    EXPECT_TRUE(watch.is_on());
    watch.saw_step(true);  // yet something moved
    EXPECT_FALSE(watch.is_on());
  }
  EXPECT_EQ(last_waited, 64);
  while (!watch.is_on()) watch.saw_step(true);
  watch.saw_rest();
  EXPECT_TRUE(watch.is_on());
  watch.saw_step(false);
  watch.saw_step(false);
  watch.saw_step(true);
  watch.saw_step(true);
  EXPECT_TRUE(watch.is_on()) << "patience is short again after a rest";
}

}  // namespace
}  // namespace carom::test
