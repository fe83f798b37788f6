// Memory of a world: it is accounted by part, and shrinking worlds give it back.
#include <gtest/gtest.h>

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
  for (int i = 0; i < 3; ++i) world.step();
  EXPECT_LT(world.memory().pairs_and_results, full.pairs_and_results / 20 + (128 << 10));
  EXPECT_LT(world.memory().bounds, full.bounds / 20 + (32 << 10));
  EXPECT_LT(world.memory().bodies, full.bodies / 5);
}

TEST(Memory, AnEmptiedWorldGivesItBack) {
  for (const WorldSettings& settings : kSettings) expect_given_back(settings, kDense);
  expect_given_back(kManifold, kDenseOriented);
}

// All bodies stay, but hardly any overlap afterwards.
void expect_given_back_after_parting(const WorldSettings& settings, const CrowdSpec& spec) {
  World world(settings);
  const std::vector<BodyId> ids = add_crowd(world, spec);
  for (int i = 0; i < 2; ++i) world.step();
  const size_t full = world.memory().pairs_and_results;
  for (int i = 0; i < 4; ++i) {
    for (size_t k = 0; k < ids.size(); ++k) world.set_position(ids[k], {3.0 * k, 0.1 * i, 0});
    world.step();
  }
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

}  // namespace
}  // namespace carom::test
