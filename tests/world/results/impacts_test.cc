// Impacts of continuous bodies: none is missed, and the first one stops the body.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/composites.h"
#include "tests/world/crowds.h"
#include "tests/world/motion/bullets.h"

namespace carom::test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(Impacts, BulletsDoNotJumpOverWalls) {
  World world(kSecond);
  const BodyId b = world.add(bullet(100));
  const BodyId w = world.add(wall(50));
  world.step();
  ASSERT_THAT(world.impacts(), SizeIs(1));
  const Impact& impact = world.impacts()[0];
  EXPECT_EQ(impact.a, b.index);
  EXPECT_EQ(impact.b, w.index);
  EXPECT_NEAR(impact.toi, (50 - 0.001 - 0.01) / 100, 1e-6);
  EXPECT_NEAR((impact.normal - Vector3f(1, 0, 0)).norm(), 0, 1e-6);
  EXPECT_NEAR((impact.arm_a - Vector3f(0.01f, 0, 0)).norm(), 0, 1e-6);
  EXPECT_NEAR(impact.arm_b.x(), -0.001, 1e-6);
  EXPECT_NEAR(impact.separation, 0, 1e-6);
  EXPECT_EQ(impact.status, Status::ok);
  EXPECT_FALSE(impact.sensor);
  EXPECT_FALSE(impact.overlap);
  EXPECT_EQ(world.first_impact(b), &impact);
  EXPECT_EQ(world.first_impact(w), &impact);
  EXPECT_EQ(world.report().overlaps, 0u);
  EXPECT_THAT(world.contacts(), IsEmpty());
  EXPECT_THAT(world.speculative_contacts(), IsEmpty());
}

TEST(Impacts, OfDiscreteBodiesThereAreNone) {
  World world(kSecond);
  world.add(bullet(100, Detection::discrete));
  world.add(wall(50));
  EXPECT_THAT(step(world), IsEmpty());
  EXPECT_THAT(world.pairs(), IsEmpty());
}

TEST(Impacts, OfAutomaticBodiesThatAreFast) {
  World world(kSecond);
  const BodyId b = world.add(bullet(0.005f, Detection::automatic));
  world.add(wall(0.014));
  EXPECT_THAT(step(world), IsEmpty()) << "slow";
  world.set_linear_velocity(b, {1, 0, 0});
  EXPECT_THAT(step(world), ElementsAre(Pair{0, 1}));
  world.set_linear_velocity(b, {0.005f, 0, 0});
  EXPECT_THAT(step(world), IsEmpty()) << "slow again";
  EXPECT_THAT(world.events(), IsEmpty());
}

// A continuous and a discrete body approach each other so fast that neither is near its present
// position when they meet.
TEST(Impacts, DiscreteBodiesAreMetOnTheirWay) {
  World world(kSecond);
  world.add(bullet(100));
  BodyDesc other = bullet(-100, Detection::discrete);
  other.position = {150, 0, 0};
  world.add(other);
  EXPECT_THAT(step(world), ElementsAre(Pair{0, 1}));
  EXPECT_NEAR(world.impacts()[0].toi, 0.75, 1e-3);
}

// A pair of discrete bodies needs bounds that overlap now, whichever other bodies look ahead.
TEST(Impacts, OthersArePairsAsEver) {
  World world(kSecond);
  for (const double x : {0.0, 3.0}) {
    world.add({.shape = Sphere{1},
               .position = {x, 50, 0},
               .linear_velocity = {x > 0 ? -9.0f : 9.0f, 0, 0}});
  }
  world.add({.shape = Sphere{1}, .position = {1.5, 51, 0}});
  world.step();
  const std::string before = as_bytes(world.pairs());
  world.add(bullet(1));
  world.step();
  EXPECT_EQ(as_bytes(world.pairs()), before);
  EXPECT_EQ(world.report().search.pairs, world.pairs().size());
}

TEST(Impacts, TheFirstOneStopsTheBody) {
  const auto three_walls = [](const WorldSettings& settings) {
    World world(settings);
    for (const double x : {30, 10, 20}) world.add(wall(x));
    world.add(bullet(100));
    return world;
  };
  World all = three_walls(kAll);
  EXPECT_THAT(step(all), ElementsAre(Pair{1, 3}, Pair{2, 3}, Pair{0, 3}));
  EXPECT_EQ(all.first_impact({3, 0}), &all.impacts()[0]);
  EXPECT_EQ(all.first_impact({0, 0}), &all.impacts()[2]);
  // For the walls behind, this impact is the first one, so it stays.
  World earliest = three_walls(kSecond);
  EXPECT_THAT(step(earliest), SizeIs(3));
}

// Two bullets hit the same wall: that is the first impact of each. An impact with the wall behind
// is kept only if it is the first one of that wall.
TEST(Impacts, EarliestOfAtLeastOneOfTheTwo) {
  for (const bool earliest : {false, true}) {
    World world(earliest ? kSecond : kAll);
    world.add(wall(10));
    world.add(wall(20));
    for (const double y : {0.0, 1.0}) {
      BodyDesc b = bullet(100);
      b.position.y() = y;
      world.add(b);
    }
    world.set_linear_velocity({3, 0}, {200, 0, 0});
    world.step();
    const std::vector<Pair> expected = earliest ? std::vector<Pair>{{0, 3}, {0, 2}, {1, 3}}
                                                : std::vector<Pair>{{0, 3}, {0, 2}, {1, 3}, {1, 2}};
    EXPECT_EQ(pairs_of(world.impacts()), expected);
    EXPECT_EQ(world.first_impact({2, 0})->a, 0u);
    EXPECT_EQ(world.first_impact({1, 0})->b, 3u);
  }
}

// A ball rolls on a floor towards a wall.
TEST(Impacts, WhatOverlapsNowDoesNotHideWhatComes) {
  World world(kSecond);
  const BodyId floor = world.add({.shape = Halfspace{{0, 0, 1}, 0}, .motion = Motion::fixed});
  const BodyId ball = world.add({.shape = Sphere{0.5f},
                                 .position = {0, 0, 0.499},
                                 .linear_velocity = {10, 0, 0},
                                 .detection = Detection::continuous});
  const BodyId barrier = world.add(wall(5));
  EXPECT_THAT(step(world), ElementsAre(Pair{0, 1}, Pair{1, 2}));
  const Impact& now = world.impacts()[0];
  ASSERT_THAT(world.contacts(), SizeIs(1));
  EXPECT_TRUE(now.overlap);
  EXPECT_EQ(now.toi, 0);
  EXPECT_EQ(now.separation, world.contacts()[0].separation);
  EXPECT_EQ(now.normal, world.contacts()[0].normal);
  EXPECT_EQ(now.arm_a, world.contacts()[0].arm_a);
  EXPECT_EQ(now.arm_b, world.contacts()[0].arm_b);
  EXPECT_EQ(world.first_impact(ball), &world.impacts()[1]);
  EXPECT_EQ(world.first_impact(barrier), &world.impacts()[1]);
  EXPECT_EQ(world.first_impact(floor), nullptr);
}

TEST(Impacts, SensorsStopNobody) {
  World world(kSecond);
  const BodyId sensor = world.add({.shape = Sphere{1}, .position = {10, 0, 0}, .sensor = true});
  world.add(wall(20));
  world.add({.shape = Sphere{1}, .position = {30, 0, 0}, .sensor = true});
  const BodyId b = world.add(bullet(100));
  EXPECT_THAT(step(world), ElementsAre(Pair{0, 3}, Pair{1, 3})) << "none behind the wall";
  const Impact& met = world.impacts()[0];
  EXPECT_TRUE(met.sensor);
  EXPECT_NEAR(met.toi, (10 - 1 - 0.01) / 100, 1e-6);
  EXPECT_TRUE(met.normal.isZero(0));
  EXPECT_TRUE(met.arm_a.isZero(0));
  EXPECT_EQ(met.separation, 0);
  EXPECT_EQ(world.first_impact(b), &world.impacts()[1]);
  EXPECT_EQ(world.first_impact(sensor), nullptr);
  world.set_sensor({1, 0}, true);
  EXPECT_THAT(step(world), SizeIs(3));
  EXPECT_EQ(world.first_impact(b), nullptr);
  world.set_position(b, {10, 0, 0});
  step(world);
  EXPECT_TRUE(world.impacts()[0].overlap);
  EXPECT_TRUE(world.impacts()[0].sensor);
}

TEST(Impacts, FiltersHold) {
  const auto meets = [](const BodyDesc& other, BodyDesc b = bullet(100)) {
    World world(kSecond);
    b.owner = 7;
    b.layer = 2;
    world.add(b);
    world.add(other);
    return !step(world).empty();
  };
  BodyDesc w = wall(50);
  EXPECT_TRUE(meets(w));
  w.owner = 7;
  EXPECT_FALSE(meets(w));
  w.owner = 8;
  EXPECT_TRUE(meets(w));
  w.mask = 1;
  EXPECT_FALSE(meets(w));
  w.mask = 2;
  EXPECT_TRUE(meets(w));
  BodyDesc fixed = bullet(100);
  fixed.motion = Motion::fixed;
  EXPECT_FALSE(meets(w, fixed));
}

// Sheets, parts and planes that the body has passed by the end of the step.
TEST(Impacts, ThinThingsOfEveryKindAreMet) {
  const Mesh sheet = grid_mesh(4, 1, [](float, float) { return 0.0f; });
  const Triangle triangle{.corners = {{{-3, -3, 0}, {3, -3, 0}, {0, 3, 0}}}};
  const Compound plate = compound_of({{.shape = Box{{3, 3, 0.001f}}, .position = {0, 0, 0}},
                                      {.shape = Sphere{0.1f}, .position = {3, 3, 0}}});
  const Shape thin[] = {sheet,
                        triangle,
                        plate,
                        Box{{3, 3, 0.001f}},
                        Halfspace{{0, 0, 1}, 0},
                        Aabb{{-3, -3, 0}, {3, 3, 0}},
                        Capsule{{-3, 0, 0}, {3, 0, 0}, 0.001f}};
  Random random(1);
  for (const Shape& target : thin) {
    for (const ShapeKind kind : kEveryKind) {
      if (kind == ShapeKind::halfspace) continue;
      for (const Detection detection : {Detection::continuous, Detection::automatic}) {
        SCOPED_TRACE(testing::Message() << name(kind_of(target)) << " and " << name(kind));
        World world(kSecond);
        world.add({.shape = target, .motion = Motion::fixed});
        Composites shapes(random.below(1000));
        const BodyId id = world.add({.shape = shapes.shape(kind, 0.2),
                                     .position = {0.02, 0.01, 20},
                                     .orientation = shapes.orientation(),
                                     .linear_velocity = {0, 0, -50},
                                     .angular_velocity = {1, 2, 3},
                                     .detection = detection});
        world.step();
        const Impact* first = world.first_impact(id);
        // One-sided sheets let bodies from behind pass, and a body may pass beside a thin rod.
        const bool may_pass = is_surface(kind) || kind == ShapeKind::triangle ||
                              kind == ShapeKind::compound ||
                              std::holds_alternative<Capsule>(target);
        if (!first) {
          EXPECT_TRUE(may_pass);
          continue;
        }
        EXPECT_NEAR(first->toi, 0.4, 0.02);
        EXPECT_EQ(first->a, 0u);
      }
    }
  }
}

TEST(Impacts, HalfspacesMoveAndTurn) {
  World world(kSecond);
  const BodyId plane = world.add({.shape = Halfspace{{0, 0, 1}, 1},
                                  .position = {0, 0, -1},
                                  .linear_velocity = {0, 0, 20},
                                  .detection = Detection::continuous});
  const BodyId ball = world.add({.shape = Sphere{1}, .position = {0, 0, 11}});
  EXPECT_THAT(step(world), ElementsAre(Pair{0, 1}));
  EXPECT_NEAR(world.impacts()[0].toi, 0.5, 1e-6);
  world.set_linear_velocity(plane, {0, 0, -20});
  EXPECT_THAT(step(world), IsEmpty());
  EXPECT_THAT(world.pairs(), IsEmpty());
  world.set_linear_velocity(plane, {0, 0, 0});
  world.set_position(ball, {100, 0, 11});
  EXPECT_THAT(step(world), IsEmpty());
  world.set_angular_velocity(plane, {0, -0.5f, 0});
  EXPECT_THAT(step(world), ElementsAre(Pair{0, 1}));
}

TEST(Impacts, FarFromTheOrigin) {
  WorldSettings settings = kSecond;
  settings.positions = PositionType::float64;
  World near(settings), far(settings);
  const Vector3d shift(0x1p30, -0x1p28, 0x1p24);
  for (World* world : {&near, &far}) {
    for (BodyDesc body : {bullet(100), wall(50)}) {
      if (world == &far) body.position += shift;
      world->add(body);
    }
    EXPECT_THAT(step(*world), SizeIs(1));
  }
  const Impact& x = near.impacts()[0];
  const Impact& y = far.impacts()[0];
  EXPECT_EQ(x.toi, y.toi);
  EXPECT_EQ(x.normal, y.normal);
  EXPECT_EQ(x.arm_a, y.arm_a);
  EXPECT_EQ(x.arm_b, y.arm_b);
  EXPECT_NEAR(x.separation, y.separation, 0x1p-22) << "what positions out there round";
}

}  // namespace
}  // namespace carom::test
