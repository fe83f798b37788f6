// Half-spaces in a world: which bodies they meet, and that they cost nothing if there are none.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/support/pairs.h"
#include "tests/support/special_floats.h"
#include "tests/world/crowds.h"

namespace carom::test {
namespace {

BodyDesc ball(double z, float radius = 0.5f) {
  return {.shape = Sphere{radius}, .position = {100, -200, z}};
}

BodyDesc ground(float offset = 0) { return {.shape = Halfspace{{0, 0, 1}, offset}}; }

// A half-space turned upside down: it fills everything above z.
BodyDesc ceiling(double z) {
  return {.shape = Halfspace{}, .position = {0, 0, z}, .orientation = {0, 1, 0, 0}};
}

TEST(Halfspaces, MeetWhatReachesIntoThem) {
  for (const PositionType positions : kPositionTypes) {
    for (const bool ground_first : {true, false}) {
      World world({.positions = positions, .persist_events = true});
      const BodyId first = world.add(ground_first ? ground() : ball(10));
      const BodyId second = world.add(ground_first ? ball(10) : ground());
      const BodyId id = ground_first ? second : first;
      EXPECT_EQ(world.step().pairs, 0u);

      world.set_position(id, {3, 4, 0.25});
      EXPECT_EQ(world.step().pairs, 1u);
      EXPECT_EQ(world.pairs()[0], (Pair{0, 1}));
      ASSERT_EQ(world.contacts().size(), 1u);
      const Contact& contact = world.contacts()[0];
      EXPECT_EQ(contact.separation, -0.25f);
      EXPECT_EQ(contact.normal, Eigen::Vector3f(0, 0, ground_first ? 1 : -1));
      ASSERT_EQ(world.events().size(), 1u);
      EXPECT_EQ(world.events()[0].kind, EventKind::begin);

      world.set_position(id, {1e6, 4, -1e6});
      EXPECT_EQ(world.step().contacts, 1u);
      EXPECT_EQ(world.events()[0].kind, EventKind::persist);
      world.set_position(id, {3, 4, 0.5});
      EXPECT_EQ(world.step().contacts, 1u);
      world.set_position(id, {3, 4, 0.625});
      EXPECT_EQ(world.step().pairs, 0u);
      ASSERT_EQ(world.events().size(), 1u);
      EXPECT_EQ(world.events()[0].kind, EventKind::end);
    }
  }
}

TEST(Halfspaces, FollowTheirOwnPoseAndRow) {
  World world;
  const BodyId plane = world.add(ground());
  world.add(ball(2));
  const auto pairs = [&] { return world.step().pairs; };
  EXPECT_EQ(pairs(), 0u);
  world.set_position(plane, {0, 0, 1.75});
  EXPECT_EQ(pairs(), 1u);
  EXPECT_EQ(pairs(), 1u);
  world.set_position(plane, {7, 8, 0});
  EXPECT_EQ(pairs(), 0u);
  world.shape_rows().rows[4 * world.first_row(plane) + 3] = 1.75f;
  EXPECT_EQ(pairs(), 1u);
  world.set_shape(plane, Halfspace{{0, 0, 10}, 10});  // fills z <= 1
  EXPECT_EQ(pairs(), 0u);
  world.set_orientation(plane, {0, 2, 0, 0});  // half a turn about x: fills z >= -1
  EXPECT_EQ(pairs(), 1u);
  world.arrays().orientation[4 * plane.index] = 0;
  world.arrays().orientation[4 * plane.index + 3] = -3;
  EXPECT_EQ(pairs(), 0u);
}

TEST(Halfspaces, TwoOfThemAreNoPair) {
  World world;
  for (int i = 0; i < 20; ++i) {
    world.add(ground(static_cast<float>(i)));
    world.add(ceiling(-i));
  }
  EXPECT_EQ(world.step().pairs, 0u);
  world.add(ball(0));
  EXPECT_EQ(world.step().pairs, 40u);
  EXPECT_EQ(world.contacts().size(), 40u);
}

TEST(Halfspaces, AreFilteredLikeOtherBodies) {
  World world({.persist_events = true});
  const BodyId plane = world.add(ground());
  const BodyId id = world.add(ball(0));
  const auto meet = [&] { return world.step().pairs == 1; };
  EXPECT_TRUE(meet());
  world.set_motion(plane, Motion::fixed);
  EXPECT_TRUE(meet());
  world.set_motion(id, Motion::fixed);
  EXPECT_FALSE(meet());
  world.set_motion(id, Motion::kinematic);
  EXPECT_TRUE(meet());
  world.set_filter(plane, 1, 2, 0);
  world.set_filter(id, 2, 2, 0);
  EXPECT_FALSE(meet());
  world.set_filter(id, 2, 1, 0);
  EXPECT_TRUE(meet());
  world.set_filter(plane, 1, 2, 5);
  world.set_filter(id, 2, 1, 5);
  EXPECT_FALSE(meet());
  world.set_filter(id, 2, 1, 0);
  EXPECT_TRUE(meet());
  for (const BodyId body : {plane, id}) world.set_group(body, -2);
  EXPECT_FALSE(meet());
  for (const BodyId body : {plane, id}) world.set_group(body, 2);
  EXPECT_TRUE(meet());
  world.set_space(id, 1);
  EXPECT_FALSE(meet());
  world.set_space(id, 0);
  world.exclude(plane, id);
  EXPECT_FALSE(meet());
  world.include_again(id, plane);
  EXPECT_TRUE(meet());
  world.set_sensor(plane, true);
  EXPECT_TRUE(meet());
  EXPECT_TRUE(world.contacts().empty());
  EXPECT_EQ(world.report().overlaps, 1u);
  ASSERT_EQ(world.events().size(), 1u);
  EXPECT_TRUE(world.events()[0].sensor);
}

TEST(Halfspaces, AreQuarantinedIfTheyMakeNoPlane) {
  const std::function<void(World&, BodyId)> spoil[] = {
      [](World& w, BodyId id) {
        w.set_orientation(id, {0, 0, 0, 0});
      },
      [](World& w, BodyId id) {
        w.set_orientation(id, {1, 0, kNan, 0});
      },
      [](World& w, BodyId id) { w.arrays().orientation[4 * id.index] = INFINITY; },
      [](World& w, BodyId id) {
        w.set_shape(id, Halfspace{{0, 0, 0}, 1});
      },
      [](World& w, BodyId id) {
        w.set_shape(id, Halfspace{{0, kNan, 1}, 1});
      },
      [](World& w, BodyId id) { w.shape_rows().rows[4 * w.first_row(id) + 3] = INFINITY; },
      [](World& w, BodyId id) {
        w.set_position(id, {0, 0, kNan});
      },
  };
  for (const PositionType positions : kPositionTypes) {
    for (const Detail detail : {Detail::pairs, Detail::contact}) {
      for (const auto& change : spoil) {
        World world({.positions = positions, .detail = detail});
        world.add(ball(0));
        const BodyId plane = world.add(ground());
        const BodyId other = world.add(ground(1));
        EXPECT_EQ(world.step().pairs, 2u);
        change(world, plane);
        for (int i = 0; i < 3; ++i) {
          EXPECT_EQ(world.step().pairs, 1u);
          ASSERT_EQ(world.quarantined().size(), 1u);
          EXPECT_EQ(world.quarantined()[0], plane);
        }
        world.remove(other);
        EXPECT_EQ(world.step().pairs, 0u);
        world.set_shape(plane, Halfspace{});
        world.set_orientation(plane, Eigen::Quaternionf::Identity());
        world.set_position(plane, {0, 0, 0});
        EXPECT_EQ(world.step().pairs, 1u);
        EXPECT_TRUE(world.quarantined().empty());
      }
    }
  }
}

TEST(Halfspaces, ComeAndGoAndBecomeOtherKinds) {
  World world({.pair_changes = true});
  const BodyId id = world.add(ball(0));
  for (int i = 0; i < 3; ++i) {
    const BodyId plane = world.add(ground());
    EXPECT_EQ(world.step().pairs, 1u);
    EXPECT_EQ(world.added_pairs().size(), 1u);
    world.set_shape(plane, Sphere{1});  // at the origin, far from the ball
    EXPECT_EQ(world.step().pairs, 0u);
    EXPECT_EQ(world.removed_pairs().size(), 1u);
    world.set_shape(id, Halfspace{});
    EXPECT_EQ(world.step().pairs, 1u);
    world.set_shape(plane, Halfspace{});
    EXPECT_EQ(world.step().pairs, 0u);
    world.set_shape(id, Sphere{0.5f});
    EXPECT_EQ(world.step().pairs, 1u);
    EXPECT_EQ(world.contacts().size(), 1u);
    world.remove(plane);
    EXPECT_EQ(world.step().pairs, 0u);
    EXPECT_EQ(world.removed_pairs().size(), 1u);
    ASSERT_EQ(world.events().size(), 1u);
    EXPECT_EQ(world.events()[0].kind, EventKind::end);
    EXPECT_EQ(world.events()[0].b, plane);
  }
}

TEST(Halfspaces, FarFromTheOriginInFloat64) {
  World world({.positions = PositionType::float64});
  const double far = 0x1p40;
  world.add({.shape = Halfspace{{1, 0, 0}, 0.5f}, .position = {far, far, far}});
  const BodyId id = world.add({.shape = Sphere{0.25f}, .position = {far + 0.625, -far, 0}});
  world.step();
  ASSERT_EQ(world.contacts().size(), 1u);
  EXPECT_EQ(world.contacts()[0].separation, -0.125f);
  world.set_position(id, {far + 0.875, -far, 0});
  world.step();
  EXPECT_EQ(world.contacts().size(), 0u);
}

TEST(Halfspaces, AStillWorldRepeatsItself) {
  const CrowdSpec spec{.oriented = true, .halfspaces = 3};
  for (const Detail detail : {Detail::pairs, Detail::overlap, Detail::contact, Detail::manifold}) {
    World world({.detail = detail});
    add_crowd(world, spec);
    for (int i = 0; i < 8; ++i) world.step();
    const Results before = results(world);
    EXPECT_FALSE(world.step().ran(Stage::broadphase));
    EXPECT_TRUE(results(world) == before);
    EXPECT_GT(world.report().pairs, 500u);
    world.set_orientation(world.id_of(1), {1, 1, 0, 0});
    EXPECT_TRUE(world.step().ran(Stage::broadphase));
    EXPECT_FALSE(results(world) == before);
  }
}

// Pairs with half-spaces count towards the limit.
TEST(Halfspaces, CanMakeAStepIncomplete) {
  constexpr size_t kBalls = 50;
  for (const BroadphaseMethod method : {BroadphaseMethod::brute, BroadphaseMethod::grid}) {
    World world({.broadphase = method, .most_pairs = 2 * kBalls - 1});
    std::vector<BodyId> planes = {world.add(ground())};
    // A row: kBalls - 1 pairs, and kBalls more with the ground.
    for (size_t i = 0; i < kBalls; ++i) {
      world.add({.shape = Sphere{0.6f}, .position = {static_cast<double>(i), 0, 0}});
    }
    const auto expect_complete = [&] {
      EXPECT_TRUE(world.step().search.complete);
      EXPECT_EQ(world.report().search.pairs, 2 * kBalls - 1);
      EXPECT_EQ(world.contacts().size(), 2 * kBalls - 1);
    };
    expect_complete();
    const BodyId more = world.add({.shape = Sphere{0.5f}, .position = {-1e3, 0, 0}});
    EXPECT_FALSE(world.step().search.complete);
    EXPECT_EQ(world.report().search.pairs, 2 * kBalls);
    EXPECT_TRUE(world.pairs().empty());
    EXPECT_TRUE(world.contacts().empty());
    EXPECT_EQ(world.events().size(), 2 * kBalls - 1);
    world.remove(more);
    expect_complete();
    planes.push_back(world.add(ground()));
    planes.push_back(world.add(ground()));
    EXPECT_FALSE(world.step().search.complete);
    EXPECT_EQ(world.report().search.pairs, 4 * kBalls - 1);
    // Too many pairs even without half-spaces.
    world.remove(planes);
    EXPECT_TRUE(world.step().search.complete);
    for (uint32_t i = 1; i <= kBalls; ++i) world.set_position(world.id_of(i), {0, 0, 0});
    world.add(ground());
    EXPECT_FALSE(world.step().search.complete);
    EXPECT_TRUE(world.pairs().empty());
  }
}

TEST(Halfspaces, CostMemoryUntilItIsGivenBack) {
  World world;
  const std::vector<BodyId> ids = add_crowd(world, {.oriented = true});
  const auto steps = [&] {
    for (int i = 0; i < 4; ++i) {
      world.set_position(ids[0], {0.1 * i, 0, 0});
      world.step();
    }
    return world.memory().broadphase;
  };
  const size_t without = steps();
  const size_t pairs = world.pairs().size_bytes();
  const BodyId plane = world.add(ground(3));
  const size_t with = steps();
  const size_t own_pairs = world.pairs().size_bytes() - pairs;
  EXPECT_GT(own_pairs, 100 * sizeof(Pair));
  EXPECT_GT(with, without + own_pairs);
  world.remove(plane);
  steps();
  world.give_back_memory();
  EXPECT_LT(steps(), with - own_pairs);
}

// The pairs of half-spaces are the same with any search method and any margin.
TEST(Halfspaces, DoNotDependOnTheSearch) {
  const CrowdSpec spec{.count = 1200, .side = 10, .oriented = true, .halfspaces = 4};
  const auto contacts = [&](const WorldSettings& settings) {
    World world(settings);
    const std::vector<BodyId> ids = add_crowd(world, spec);
    Random random(1);
    std::string all;
    for (int i = 0; i < 5; ++i) {
      world.step();
      all += as_bytes(world.contacts()) + as_bytes(world.manifolds());
      move_some(world, ids, 0.3, random);
      turn_some(world, ids, 0.3, random);
    }
    return all;
  };
  const std::string expected = contacts({.detail = Detail::manifold});
  EXPECT_GT(expected.size(), 5000 * sizeof(Contact));
  for (const BroadphaseMethod method :
       {BroadphaseMethod::brute, BroadphaseMethod::sweep, BroadphaseMethod::grid}) {
    for (const float margin : {0.0f, 0.1f}) {
      EXPECT_TRUE(contacts({.detail = Detail::manifold, .broadphase = method, .margin = margin}) ==
                  expected);
    }
  }
}

}  // namespace
}  // namespace carom::test
