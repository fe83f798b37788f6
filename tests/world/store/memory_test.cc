// Memory of a world: it is accounted by part, and given back when the caller asks.
#include <gtest/gtest.h>

#include <utility>

#include "carom/base/thread_arena.h"
#include "tests/world/crowds.h"

namespace carom::test {
namespace {

constexpr CrowdSpec kDense{.count = 20000, .side = 18};

TEST(Memory, IsTheSumOfItsParts) {
  World world;
  add_crowd(world, kDense);
  world.step();
  const WorldMemory memory = world.memory();
  EXPECT_EQ(world.bytes(),
            memory.bodies + memory.bounds + memory.broadphase + memory.pairs_and_results);
  EXPECT_GE(memory.bodies, kDense.count * 4 * sizeof(float));
  EXPECT_GE(memory.bounds, kDense.count * 6 * sizeof(float));
  EXPECT_GT(memory.broadphase, 0u);
  EXPECT_GE(memory.pairs_and_results, world.pairs().size_bytes() + world.contacts().size_bytes());
}

// A chain of balls, to which one that touches comes in each step: contacts stay in their list,
// which grows. It once asked for as many places as there are contacts for each pair.
TEST(Memory, OfContactsThatStayGrowsWithThem) {
  for (const Detail detail : {Detail::contact, Detail::manifold}) {
    for (const bool gives_back : {false, true}) {
      constexpr size_t kBalls = 500, kMore = 150;
      World world({.detail = detail, .parallelism = Parallelism::none});
      for (size_t i = 0; i < kBalls; ++i) {
        world.add({.shape = Sphere{0.55f}, .position = {static_cast<double>(i), 0, 0}});
      }
      world.step();
      world.step();
      const size_t before = world.bytes();
      if (gives_back) world.give_back_memory();
      for (size_t i = 0; i < kMore; ++i) {
        world.add({.shape = Sphere{0.1f}, .position = {static_cast<double>(i), 0.5, 0}});
        world.step();
        ASSERT_EQ(world.contacts().size(), kBalls + i);
        ASSERT_EQ(world.report().tested, 1u);
        ASSERT_LT(world.bytes(), 2 * before) << i;
      }
    }
  }
}

const WorldSettings kSettings[] = {{},
                                   {.pair_changes = true},
                                   {.detail = Detail::pairs},
                                   {.detail = Detail::overlap, .carry_results = false},
                                   {.events = false, .margin = 0.1f},
                                   {.dop_bounds = DopKind::k26}};

const WorldSettings kManifold{.detail = Detail::manifold};
constexpr CrowdSpec kDenseOriented{.count = 8000, .side = 13, .oriented = true, .halfspaces = 2};

void expect_given_back(const WorldSettings& settings, const CrowdSpec& spec) {
  World world(settings);
  const std::vector<BodyId> ids = add_crowd(world, spec);
  Random random(1);
  for (int i = 0; i < 3; ++i) {
    world.step();
    move_some(world, ids, 0.3, random);
  }
  world.step();
  const WorldMemory full = world.memory();
  world.remove(ids);
  for (int i = 0; i < 3; ++i) world.step();  // the first has an event for every pair that was
  world.give_back_memory();
  EXPECT_LT(world.memory().pairs_and_results, full.pairs_and_results / 20 + (128 << 10));
  EXPECT_LT(world.memory().bounds, full.bounds / 20 + (32 << 10));
  EXPECT_LT(world.memory().bodies, full.bodies / 5);
}

TEST(Memory, AnEmptiedWorldGivesItBackWhenAsked) {
  for (const WorldSettings& settings : kSettings) expect_given_back(settings, kDense);
  expect_given_back(kManifold, kDenseOriented);
}

// All bodies stay, but hardly any overlap afterwards.
void expect_given_back_after_parting(const WorldSettings& settings, const CrowdSpec& spec) {
  World world(settings);
  const std::vector<BodyId> ids = add_crowd(world, spec);
  for (int i = 0; i < 2; ++i) world.step();
  const size_t full = world.memory().pairs_and_results;
  for (int i = 0; i < 2; ++i) {
    for (size_t k = 0; k < ids.size(); ++k) world.set_position(ids[k], {3.0 * k, 0.1 * i, 0});
    world.step();
  }
  world.give_back_memory();
  EXPECT_LT(world.memory().pairs_and_results, full / 10 + (256 << 10));
}

TEST(Memory, BodiesThatPartGiveThatOfTheirPairsBack) {
  for (const WorldSettings& settings : kSettings) {
    expect_given_back_after_parting(settings, kDense);
  }
  CrowdSpec oriented = kDenseOriented;
  oriented.halfspaces = 0;
  expect_given_back_after_parting(kManifold, oriented);
}

// The contacts of the last step are there only where some are carried over.
TEST(Memory, WhereAllBodiesMoveContactsAreHeldOnce) {
  World world({.detail = Detail::manifold});
  const std::vector<BodyId> ids = add_crowd(world, kDense);
  Random random(6);
  const auto step = [&](double share) {
    move_some(world, ids, share, random);
    world.step();
    return world.memory().pairs_and_results;
  };
  size_t all_move = 0;
  for (int i = 0; i < 4; ++i) all_move = step(1);
  ASSERT_EQ(world.report().kept, 0u);
  const size_t contacts = world.contacts().size();
  ASSERT_GT(contacts, 10000u);
  const size_t some_move = step(0.1);
  ASSERT_GT(world.report().kept, 10000u);
  EXPECT_GT(some_move, all_move + contacts * (sizeof(Contact) + sizeof(ManifoldPoints)) * 9 / 10);
}

// Bodies that shake in their places: pairs come and go, and are as many in all. A list that grew
// now and then would make its step wait for the system.
void expect_steady(const WorldSettings& settings) {
  World world(settings);
  const std::vector<BodyId> ids = add_crowd(world, kDense);
  std::vector<Eigen::Vector3d> home;
  for (const BodyId id : ids) home.push_back(world.position(id));
  Random random(7);
  size_t used = 0, events = 0, growing_steps = 0;
  for (int step = 0; step < 40; ++step) {
    for (size_t i = 0; i < ids.size(); ++i) {
      world.set_position(ids[i], home[i] + random_position(random, 0.1));
    }
    world.step();
    const size_t before = std::exchange(used, world.bytes());
    if (step >= 10) growing_steps += used > before;
    events += world.events().size();
  }
  EXPECT_LE(growing_steps, 2u);
  if (settings.detail != Detail::pairs) {
    EXPECT_GT(events, 10000u);
  }
}

TEST(Memory, OfABusyWorldStaysAsItIs) {
  ThreadArena arena(2);
  for (const Detail detail : {Detail::pairs, Detail::contact, Detail::manifold}) {
    expect_steady({.detail = detail, .parallelism = Parallelism::none});
    arena.run([&] { expect_steady({.detail = detail, .parallelism = arena.parallelism()}); });
  }
}

// A world that gives memory back now and then, and one that never does.
void expect_same_results_after_giving_back(const WorldSettings& settings, const CrowdSpec& spec) {
  World world(settings), other(settings);
  const std::vector<BodyId> ids = add_crowd(world, spec), other_ids = add_crowd(other, spec);
  Random random(3), other_random(3), chance(4);
  size_t overlaps = 0;
  for (int step = 0; step < 12; ++step) {
    // The world rests in some steps.
    const double share = step % 3 == 0 ? 0 : 0.3;
    move_some(world, ids, share, random);
    move_some(other, other_ids, share, other_random);
    if (chance.chance(0.4)) world.give_back_memory();
    world.step();
    other.step();
    if (chance.chance(0.4)) world.give_back_memory();
    ASSERT_EQ(results(world), results(other)) << "step " << step;
    overlaps += world.report().overlaps;
  }
  EXPECT_GT(overlaps, settings.detail == Detail::pairs ? 0u : 100u);
}

TEST(Memory, GivingItBackChangesNoResult) {
  CrowdSpec spec{.oriented = true, .halfspaces = 2, .filters = true, .velocities = true};
  for (const WorldSettings& settings : kSettings) {
    if (settings.detail != Detail::pairs) expect_same_results_after_giving_back(settings, spec);
  }
  expect_same_results_after_giving_back(kManifold, spec);
  expect_same_results_after_giving_back({.detail = Detail::manifold, .identities = true}, spec);
  spec.looks_ahead = true;
  expect_same_results_after_giving_back(kManifold, spec);
}

}  // namespace
}  // namespace carom::test
