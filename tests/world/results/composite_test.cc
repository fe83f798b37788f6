// Worlds with meshes and compounds: every step equals the reference, also with kept results.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <span>

#include "tests/support/composites.h"
#include "tests/support/rounds.h"
#include "tests/world/histories.h"

namespace carom::test {
namespace {

// A ground, compounds and small meshes that fall on it, and simple bodies of all kinds.
void add_bodies(History& history, Composites& composites, size_t count, double side) {
  BodyDesc ground;
  ground.shape = grid_mesh(6, static_cast<float>(side) / 6,
                           [&](float, float) { return composites.random().uniform(-0.3, 0.3); });
  ground.position = {side / 2, side / 2, 0.3};
  ground.motion = Motion::fixed;
  history.add(ground);
  for (size_t i = 0; i < count; ++i) {
    BodyDesc body = history.random_body(side, true);
    const double kind = composites.random().uniform(0, 1);
    if (kind < 0.3) body.shape = composites.compound(0.6, 4);
    if (kind >= 0.3 && kind < 0.45) body.shape = composites.mesh(0.6, 8);
    if (kind >= 0.4 && kind < 0.45) body.shape = composites.height_field(0.6);
    if (kind < 0.02) body.shape = Mesh{};
    if (kind < 0.45) body.orientation = composites.orientation();
    body.position.z() /= 2;
    history.add(body);
  }
}

Coverage expect_reference(const WorldSettings& settings, uint32_t seed) {
  History history(settings, seed, Kinds::all);
  Composites composites(seed);
  add_bodies(history, composites, 40, 4);
  for (int step = 0; step < 16; ++step) {
    SCOPED_TRACE(testing::Message() << "step " << step << ", seed " << seed);
    history.step_and_check();
    if (testing::Test::HasFailure()) return history.coverage;
    if (step % 4 == 3) continue;  // a step in which nothing moves
    history.move(0.3, 0.1);
    history.turn(0.2);
    if (step % 3 == 0) history.remove_random();
  }
  EXPECT_GT(history.coverage.overlapping, 50u);
  EXPECT_TRUE(history.coverage.kept > 50 || !settings.carry_results);
  return history.coverage;
}

WorldSettings settings_with(Detail detail, PositionType positions) {
  WorldSettings settings;
  settings.detail = detail;
  settings.positions = positions;
  return settings;
}

TEST(CompositeWorld, StepsAreThoseOfTheReference) {
  for (const Detail detail : {Detail::overlap, Detail::contact, Detail::manifold}) {
    for (const PositionType positions : kPositionTypes) {
      expect_reference(settings_with(detail, positions), 1 + static_cast<uint32_t>(detail));
    }
  }
}

// Limits that leave contacts out, of pairs that are tested and of those whose results are kept.
TEST(CompositeWorld, RegionsAreThoseOfTheReference) {
  constexpr RegionLimits kLimits[] = {
      {.cosine = 0.999, .most = 2}, {.cosine = 0.6, .most = 1}, {.cosine = 0.99, .most = 3}};
  uint32_t seed = 20;
  size_t left_out = 0;
  for (const RegionLimits& limits : std::span(kLimits).first(rounds(3))) {
    for (const float distance : {0.0f, 0.1f}) {
      for (const bool carries : {true, false}) {
        WorldSettings settings =
            settings_with(Detail::regions, seed % 2 ? PositionType::float64 : kFloat32);
        settings.region_limits = limits;
        settings.contact_distance = distance;
        settings.carry_results = carries;
        left_out += expect_reference(settings, seed++).left_out;
      }
    }
  }
  EXPECT_GT(left_out, 100u);
}

TEST(CompositeWorld, ThreadsChangeNothing) {
  WorldSettings settings = settings_with(Detail::manifold, PositionType::float64);
  settings.parallelism = Parallelism::arena;
  tbb::task_arena arena(2);
  arena.execute([&] { expect_reference(settings, 7); });
}

// k-DOPs drop separate pairs only.
TEST(CompositeWorld, DopBoundsLoseNothing) {
  WorldSettings settings = settings_with(Detail::contact, PositionType::float32);
  settings.dop_bounds = DopKind::k26;
  expect_reference(settings, 8);
}

// Compounds and meshes of many parts, whose hulls are looked at first, among others.
size_t expect_reference_of_many_parts(const WorldSettings& settings, uint32_t seed) {
  History history(settings, seed, Kinds::all);
  Composites composites(seed);
  for (size_t i = 0; i < 30; ++i) {
    BodyDesc body = history.random_body(4, true);
    const size_t kind = i % 5;
    if (kind < 2) body.shape = composites.compound_of_many(0.6, 7 + i % 6);
    if (kind == 2) body.shape = composites.mesh(0.6, 24);
    if (kind == 3 && i < 5) body.shape = Mesh{};
    if (kind < 3) body.orientation = composites.orientation();
    history.add(body);
  }
  size_t dropped = 0;
  for (int step = 0; step < 12; ++step) {
    SCOPED_TRACE(testing::Message() << "step " << step << ", seed " << seed);
    history.step_and_check();
    if (testing::Test::HasFailure()) break;
    dropped += history.world().report().dropped;
    history.move(0.3, 0.1);
    history.turn(0.2);
    if (step % 3 == 0) history.remove_random();
  }
  return dropped;
}

TEST(CompositeWorld, HullsThatAreApartChangeNothing) {
  size_t dropped = 0;
  for (const Detail detail : {Detail::overlap, Detail::contact, Detail::manifold}) {
    for (const PositionType positions : kPositionTypes) {
      for (const bool carries : {true, false}) {
        WorldSettings settings = settings_with(detail, positions);
        settings.carry_results = carries;
        dropped += expect_reference_of_many_parts(settings, 40 + static_cast<uint32_t>(detail));
      }
    }
  }
  EXPECT_GT(dropped, 20u);
}

// A box lies on a mesh and is pushed across its edges: it has one contact, with the plane's normal,
// that names the triangle below.
TEST(CompositeWorld, ABoxThatSlidesOverAMeshHasOneContact) {
  WorldSettings settings = settings_with(Detail::manifold, PositionType::float32);
  settings.persist_events = true;
  World world(settings);
  world.add({.shape = flat_grid(10, 1), .motion = Motion::fixed});
  const BodyId box = world.add({.shape = Box{{0.4f, 0.4f, 0.25f}}, .position = {-4, 0.3, 0.249}});
  for (int step = 0; step < 40; ++step) {
    world.step();
    ASSERT_EQ(world.contacts().size(), 1u);
    const Contact& contact = world.contacts()[0];
    EXPECT_EQ(contact.a, 0u);
    EXPECT_LT(contact.sub_a, 200u);
    EXPECT_EQ(contact.sub_b, 0u);
    EXPECT_NEAR(contact.normal.z(), 1, 1e-6);
    EXPECT_NEAR(contact.separation, -0.001, 1e-6);
    EXPECT_GE(contact.manifold_count, 3);
    EXPECT_EQ(world.events()[0].kind, step == 0 ? EventKind::begin : EventKind::persist);
    world.set_position(box, world.position(box) + Eigen::Vector3d(0.1, 0.003, 0));
  }
}

}  // namespace
}  // namespace carom::test
