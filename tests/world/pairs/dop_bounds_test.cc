// Worlds that drop pairs by k-DOPs: fewer tests, the same results.
#include <gtest/gtest.h>

#include "carom/base/thread_arena.h"
#include "tests/support/isas.h"
#include "tests/support/rounds.h"
#include "tests/world/histories.h"

namespace carom::test {
namespace {

constexpr DopKind kDopKinds[] = {DopKind::k14, DopKind::k18, DopKind::k26};

void run_history(const WorldSettings& settings, uint32_t seed, Coverage* coverage = nullptr) {
  SCOPED_TRACE(::testing::Message() << "seed " << seed);
  History history(settings, seed, Kinds::all);
  const bool filters = seed % 3 != 0;
  const double side = history.uniform(2, 8);
  const auto churn = [&](double count) { return static_cast<int>(history.uniform(0, count)); };
  if (coverage) history.coverage = *coverage;
  for (int i = churn(200); i > 0; --i) history.add(history.random_body(side, filters));
  for (int step = 0; step < 8; ++step) {
    for (int i = churn(10); i > 0; --i) history.add(history.random_body(side, filters));
    for (int i = churn(10); i > 0; --i) history.remove_random();
    if (history.chance(0.7)) history.move(history.uniform(0, 1), 0.2);
    if (history.chance(0.5)) history.turn(history.uniform(0, 1));
    if (history.chance(0.4)) history.write_rows(history.uniform(0, 0.5));
    history.change_random_body(side, filters);
    history.step_and_check();
    if (::testing::Test::HasFailure()) return;
    if (history.chance(0.2)) history.step_and_check();  // a still step
  }
  if (coverage) *coverage = history.coverage;
}

TEST(DopWorlds, HistoriesMatchTheReference) {
  constexpr Detail kDetails[] = {Detail::manifold, Detail::contact, Detail::overlap};
  Coverage coverage;
  for (uint32_t seed = 0; seed < rounds(150); ++seed) {
    WorldSettings settings;
    settings.positions = seed % 2 ? PositionType::float64 : PositionType::float32;
    settings.detail = kDetails[seed / 2 % 3];
    settings.carry_results = seed % 5 != 0;
    settings.dop_bounds = kDopKinds[seed / 3 % 3];
    run_history(settings, seed, &coverage);
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(coverage.dropped, coverage.pairs / 20);
  EXPECT_GT(coverage.kept, coverage.pairs / 20);
  EXPECT_GT(coverage.tested, coverage.pairs / 10);
  EXPECT_GT(coverage.quarantined, rounds(100));
  EXPECT_GT(coverage.halfspace_overlaps, rounds(500));
}

TEST(DopWorlds, HistoriesMatchTheReferenceOnEveryIsaAndOnThreads) {
  for_each_isa([&] {
    for (uint32_t seed = 200; seed < 210; ++seed) run_history({.dop_bounds = DopKind::k18}, seed);
  });
  ThreadArena arena(4);
  arena.run([&] {
    for (uint32_t seed = 210; seed < 220; ++seed) run_history({.dop_bounds = DopKind::k26}, seed);
  });
}

// Crowds large enough for many blocks. With a margin the reference has other candidate pairs, so
// worlds are compared with each other.
void expect_same_results(WorldSettings settings, const CrowdSpec& spec, DopKind kind) {
  World plain(settings);
  settings.dop_bounds = kind;
  World tight(settings);
  const std::vector<BodyId> ids = add_crowd(plain, spec);
  ASSERT_EQ(add_crowd(tight, spec), ids);
  for (int step = 0; step < 6; ++step) {
    plain.step();
    tight.step();
    const Results got = results(tight), expected = results(plain);
    EXPECT_TRUE(got.pairs == expected.pairs);
    EXPECT_TRUE(got.overlaps == expected.overlaps);
    EXPECT_TRUE(got.contacts == expected.contacts);
    EXPECT_TRUE(got.manifolds == expected.manifolds);
    EXPECT_TRUE(got.events == expected.events);
    EXPECT_EQ(as_bytes(tight.added_pairs()), as_bytes(plain.added_pairs()));
    EXPECT_EQ(as_bytes(tight.removed_pairs()), as_bytes(plain.removed_pairs()));
    EXPECT_EQ(tight.report().kept, plain.report().kept);
    EXPECT_EQ(tight.report().tested + tight.report().dropped, plain.report().tested);
    if (step == 0) {
      EXPECT_GT(tight.report().dropped, 0u);
    }
    if (step == 3) continue;  // a still step
    for (World* world : {&plain, &tight}) {
      Random random(static_cast<uint64_t>(step));
      move_some(*world, ids, step == 1 ? 1 : 0.3, random);
      turn_some(*world, ids, 0.2, random);
    }
  }
}

TEST(DopWorlds, HaveTheSameResultsAsWithout) {
  for (const DopKind kind : kDopKinds) {
    for (const float margin : {0.0f, 0.2f}) {
      const CrowdSpec spec{.oriented = true, .halfspaces = 3, .filters = margin > 0};
      expect_same_results({.detail = Detail::manifold, .margin = margin, .pair_changes = true},
                          spec, kind);
      expect_same_results({.carry_results = false, .margin = margin, .pair_changes = true}, spec,
                          kind);
    }
  }
}

TEST(DopWorlds, HaveTheSameResultsOnThreads) {
  const CrowdSpec spec{.count = 5000, .side = 16, .oriented = true, .halfspaces = 2};
  for (const int threads : {1, 2, 4}) {
    ThreadArena arena(threads);
    arena.run([&] {
      expect_same_results({.parallelism = arena.parallelism(), .pair_changes = true}, spec,
                          DopKind::k14);
    });
  }
}

// Two parallel rods, diagonal to the axes: only their boxes overlap.
TEST(DopWorlds, PairsThatAreDroppedStayPairs) {
  World world({.dop_bounds = DopKind::k18});
  const Eigen::Quaternionf turned(Eigen::AngleAxisf(0.785398185f, Eigen::Vector3f::UnitZ()));
  const BodyId first = world.add({.shape = Box{{5, 0.1f, 0.1f}}, .orientation = turned});
  world.add({.shape = Box{{5, 0.1f, 0.1f}}, .position = {1, -1, 0}, .orientation = turned});
  EXPECT_EQ(world.step().dropped, 1u);
  EXPECT_EQ(world.report().tested, 0u);
  EXPECT_EQ(world.pairs().size(), 1u);
  EXPECT_EQ(world.overlaps()[0], 0);
  EXPECT_TRUE(world.contacts().empty());
  EXPECT_EQ(world.step().dropped, 0u);  // kept from the last step
  EXPECT_EQ(world.report().kept, 1u);
  world.set_position(first, {1, -1, 0});
  EXPECT_EQ(world.step().dropped, 0u);
  EXPECT_EQ(world.report().tested, 1u);
  EXPECT_EQ(world.contacts().size(), 1u);
}

}  // namespace
}  // namespace carom::test
