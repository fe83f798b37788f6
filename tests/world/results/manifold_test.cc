// Contact manifolds: one a contact, kept from step to step like the contacts themselves.
#include <gtest/gtest.h>

#include "tests/world/crowds.h"

namespace carom::test {
namespace {

constexpr CrowdSpec kCrowd{.oriented = true, .halfspaces = 2, .filters = true, .velocities = true};
constexpr WorldSettings kManifold{.detail = Detail::manifold};

std::string counts(const World& world) {
  std::string counts;
  for (const Contact& contact : world.contacts()) {
    counts.push_back(static_cast<char>(contact.manifold_count));
  }
  return counts;
}

TEST(Manifolds, ThereIsOneAContact) {
  World world(kManifold);
  add_crowd(world, kCrowd);
  world.step();
  ASSERT_GT(world.contacts().size(), 100u);
  ASSERT_EQ(world.manifolds().size(), world.contacts().size());
  for (size_t i = 0; i < world.contacts().size(); ++i) {
    const Contact& contact = world.contacts()[i];
    const ManifoldPoints& points = world.manifolds()[i];
    ASSERT_GE(contact.manifold_count, 1);
    ASSERT_LE(contact.manifold_count, 4);
    for (size_t k = contact.manifold_count; k < 4; ++k) {
      EXPECT_EQ(points.point[k], (std::array<float, 3>{}));
      EXPECT_EQ(points.separation[k], 0);
    }
  }
}

TEST(Manifolds, OfABoxOnTheGround) {
  World world(kManifold);
  const BodyId crate = world.add({.shape = Box{{1, 2, 0.5f}}, .position = {10, 20, 0.375}});
  world.add({.shape = Halfspace{}});
  world.step();
  ASSERT_EQ(world.manifolds().size(), 1u);
  EXPECT_EQ(world.contacts()[0].a, crate.index);
  EXPECT_EQ(world.contacts()[0].manifold_count, 4);
  for (int k = 0; k < 4; ++k) {
    const std::array<float, 3> point = world.manifolds()[0].point[k];
    EXPECT_EQ(std::abs(point[0]), 1);  // relative to the crate
    EXPECT_EQ(std::abs(point[1]), 2);
    EXPECT_EQ(point[2], -0.5f);
    EXPECT_EQ(world.manifolds()[0].separation[k], -0.125f);
  }
}

TEST(Manifolds, ChangeNothingElse) {
  World with(kManifold), without;
  add_crowd(with, kCrowd);
  add_crowd(without, kCrowd);
  with.step();
  without.step();
  EXPECT_TRUE(without.manifolds().empty());
  EXPECT_EQ(as_bytes(with.pairs()), as_bytes(without.pairs()));
  EXPECT_EQ(as_bytes(with.overlaps()), as_bytes(without.overlaps()));
  EXPECT_EQ(as_bytes(with.events()), as_bytes(without.events()));
  ASSERT_EQ(with.contacts().size(), without.contacts().size());
  for (size_t i = 0; i < with.contacts().size(); ++i) {
    Contact contact = with.contacts()[i];
    contact.manifold_count = 0;
    EXPECT_EQ(std::memcmp(&contact, &without.contacts()[i], sizeof contact), 0);
  }
  EXPECT_GE(with.memory().pairs_and_results,
            without.memory().pairs_and_results + with.manifolds().size_bytes());
}

TEST(Manifolds, AreCarriedWithTheirContacts) {
  for (const PositionType positions : {PositionType::float32, PositionType::float64}) {
    WorldSettings settings = kManifold;
    settings.positions = positions;
    World carrying(settings);
    settings.carry_results = false;
    World testing(settings);
    const std::vector<BodyId> ids = add_crowd(carrying, kCrowd);
    add_crowd(testing, kCrowd);
    Random one(5), two(5);
    size_t kept = 0;
    for (int frame = 0; frame < 12; ++frame) {
      carrying.step();
      testing.step();
      ASSERT_EQ(as_bytes(carrying.manifolds()), as_bytes(testing.manifolds())) << frame;
      ASSERT_EQ(counts(carrying), counts(testing)) << frame;
      EXPECT_TRUE(results(carrying) == results(testing));
      kept += carrying.report().kept;
      if (frame % 4 == 3) continue;  // a still step
      move_some(carrying, ids, 0.1, one);
      turn_some(carrying, ids, 0.1, one);
      move_some(testing, ids, 0.1, two);
      turn_some(testing, ids, 0.1, two);
    }
    EXPECT_GT(kept, 1000u);
  }
}

TEST(Manifolds, AreNotMadeForSensors) {
  World world(kManifold);
  const BodyId id = world.add({.shape = Box{{1, 1, 1}}});
  world.add({.shape = Box{{1, 1, 1}}, .position = {1.5, 0, 0}});
  world.add({.shape = Box{{1, 1, 1}}, .position = {3, 0, 0}});
  world.step();
  EXPECT_EQ(world.manifolds().size(), 2u);
  world.set_sensor(id, true);
  world.step();
  EXPECT_EQ(world.report().overlaps, 2u);
  ASSERT_EQ(world.manifolds().size(), 1u);
  EXPECT_EQ(world.contacts()[0].a, 1u);
  EXPECT_EQ(world.contacts()[0].manifold_count, 4);
}

TEST(Manifolds, GoWithTheirBodies) {
  World world(kManifold);
  const std::vector<BodyId> ids = add_crowd(world, kCrowd);
  world.step();
  EXPECT_GT(world.manifolds().size(), 0u);
  world.remove(ids);
  world.step();
  EXPECT_TRUE(world.manifolds().empty());
}

}  // namespace
}  // namespace carom::test
