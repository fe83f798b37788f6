// Models that stand for shapes in worlds with a tolerance.
#include <gtest/gtest.h>

#include "carom/hulls/build_hull.h"
#include "carom/ladders/build_ladder.h"
#include "carom/reference/reference.h"
#include "carom/shapes/compound_geometry.h"
#include "carom/world/world.h"
#include "oracle/random.h"
#include "tests/support/composites.h"
#include "tests/support/hulls.h"
#include "tests/support/laddered_cube.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using oracle::Random;

Hull random_hull(size_t points, Random& random) {
  std::vector<Eigen::Vector3f> all;
  for (size_t i = 0; i < points; ++i) all.push_back(random.direction().cast<float>());
  return {build_hull(all)->geometry};
}

Orientation random_turn(Random& random) {
  return Eigen::AngleAxisf(static_cast<float>(random.uniform(-3, 3)),
                           random.direction().cast<float>()) *
         Eigen::Quaternionf::Identity();
}

Hull bevelled_hull(Random& random) {
  const Eigen::Vector3f half(0.6f, 0.8f, static_cast<float>(random.uniform(0.4, 1)));
  return {build_hull(bevelled_corners(half, 0.14f))->geometry};
}

Shape laddered(const Shape& shape, double tolerance) {
  return build_ladder(shape, std::vector{error_within(tolerance)})->shape;
}

World world_within(float tolerance, Tier tier = Tier::standard) {
  return World({.accuracy = {.tier = tier, .tolerance = tolerance}});
}

// Whether two cubes that are 2.2 apart along x overlap: balls do, cubes do not.
bool are_balls(World& world) {
  world.step();
  return world.report().overlaps == 1;
}

TEST(Models, StandForShapesWhereTheToleranceAllowsThem) {
  const float enough = 2 * 0.5f / 0.875f * 1.001f;
  for (const float tolerance : {0.0f, 0.99f * enough, enough}) {
    World world = world_within(tolerance);
    const BodyId a = world.add({.shape = cube_with_ball()});
    world.add({.shape = cube_with_ball(), .position = {2.2, 0, 0}});
    EXPECT_EQ(are_balls(world), tolerance == enough);
    // The world gives the shape itself back.
    const Hull hull = std::get<Hull>(world.shape(a));
    EXPECT_EQ(hull.geometry->points().size(), 8u);
    EXPECT_TRUE(hull.ladder);
  }
}

TEST(Models, FollowTheToleranceOfTheBody) {
  World world = world_within(0);
  const BodyId a = world.add({.shape = cube_with_ball(), .tolerance = 2.0f});
  const BodyId b =
      world.add({.shape = cube_with_ball(), .position = {2.2, 0, 0}, .tolerance = 2.0f});
  EXPECT_TRUE(are_balls(world));
  world.set_tolerance(b, std::nullopt);
  world.set_tolerance(a, 0.1f);
  EXPECT_FALSE(are_balls(world));
  world.set_tolerance(a, 3.0f);
  world.set_tolerance(b, 3.0f);
  EXPECT_TRUE(are_balls(world));
  world.set_shape(a, Box{{1, 1, 1}});
  world.set_shape(b, Box{{1, 1, 1}});
  EXPECT_FALSE(are_balls(world));
  EXPECT_TRUE(std::holds_alternative<Box>(world.shape(a)));
  world.remove(a);
  world.add({.shape = cube_with_ball()});
  world.set_shape(b, cube_with_ball());
  world.set_tolerance(b, std::nullopt);
  EXPECT_FALSE(are_balls(world));
}

TEST(Models, TheReportCountsThePairsThatTheyDecide) {
  for (const float tolerance : {0.1f, 3.0f}) {
    World world = world_within(tolerance);
    world.add({.shape = cube_with_ball()});
    world.add({.shape = cube_with_ball(), .position = {1.5, 0, 0}});
    world.add({.shape = Box{{1, 1, 1}}, .position = {0.75, 1.5, 0}});
    world.add({.shape = Box{{1, 1, 1}}, .position = {0.75, 3, 0}});
    world.step();
    EXPECT_EQ(world.report().tested, 4u);  // two balls, each with a box; two boxes
    EXPECT_EQ(world.report().by_models, tolerance > 1 ? 3u : 0u);
    EXPECT_EQ(world.report().by_rung[0], tolerance > 1 ? 3u : 0u);
  }
}

// Balls that grow, each a rung. Of two models the further one counts, and all beyond the fourth
// count with it.
TEST(Models, TheReportCountsRungs) {
  for (uint32_t a = 0; a <= 6; ++a) {
    for (uint32_t b = 0; b <= 6; ++b) {
      World world = world_within(0);
      const auto add = [&world](uint32_t rung, double x) {
        Ladder ladder;
        for (int k = 1; k <= 6; ++k)
          ladder.rungs.push_back(
              {Capsule{{0, 0, 0}, {0, 0, 0}, 1 + 0.1f * static_cast<float>(k)}, 0.5 * k});
        Hull cube = oracle::hull_of(cube_corners());
        cube.ladder = std::make_shared<const Ladder>(ladder);
        const float enough = static_cast<float>((0.5 * rung + 0.25) * 2 / kShareOfRungs);
        world.add({.shape = cube, .position = {x, 0, 0}, .tolerance = enough});
      };
      add(a, 0);
      add(b, 1);
      world.step();
      const StepReport& report = world.report();
      ASSERT_EQ(report.tested, 1u);
      for (uint32_t k = 0; k < kCountedRungs; ++k) {
        EXPECT_EQ(report.by_rung[k], std::min(std::max(a, b), 4u) == k + 1) << a << b;
      }
      EXPECT_EQ(report.by_models, a > 0 || b > 0);
    }
  }
}

TEST(Models, AreNotForProofs) {
  for (const Tier tier : {Tier::certified, Tier::exact}) {
    World world = world_within(3, tier);
    world.add({.shape = cube_with_ball()});
    world.add({.shape = cube_with_ball(), .position = {2.2, 0, 0}});
    EXPECT_FALSE(are_balls(world));
  }
}

// The promise, in space and time together: hulls, those that boxes stand for, and compounds of
// either, all of which creep.
TEST(Models, SeparationsAreOffByTheToleranceAtMost) {
  constexpr float kTolerance = 0.15f;
  size_t simpler = 0, overlaps = 0;
  for (uint64_t seed = 0; seed < rounds(6); ++seed) {
    Random random(seed);
    std::vector<Shape> shapes;
    for (int i = 0; i < 3; ++i) shapes.push_back(laddered(random_hull(100, random), kTolerance));
    for (int i = 0; i < 2; ++i) {
      std::vector<CompoundChild> children(3);
      for (CompoundChild& child : children) {
        child.shape = random_hull(60, random);
        child.position = (0.7 * random.direction()).cast<float>();
      }
      shapes.push_back(laddered(compound_of(children), kTolerance));
      shapes.push_back(laddered(bevelled_hull(random), kTolerance));
      ASSERT_TRUE(std::holds_alternative<Box>(ladder_of(shapes.back())->rungs.front().shape));
      for (CompoundChild& child : children) {
        child.shape = bevelled_hull(random);
        child.orientation = random_turn(random);
      }
      shapes.push_back(laddered(compound_of(children), kTolerance));
    }
    World world = world_within(kTolerance);
    std::vector<BodyId> ids;
    for (int i = 0; i < 60; ++i) {
      const Eigen::Vector3d place = 4 * std::cbrt(random.uniform(0, 1)) * random.direction();
      ids.push_back(world.add({.shape = shapes[random.below(shapes.size())],
                               .position = place,
                               .orientation = random_turn(random)}));
    }
    for (int step = 0; step < 6; ++step) {
      world.step();
      simpler += world.report().pairs;
      overlaps += world.report().overlaps;
      for (size_t i = 0; i < world.pairs().size(); ++i) {
        const Pair pair = world.pairs()[i];
        const BodyId a = world.id_of(pair.a), b = world.id_of(pair.b);
        const double separation =
            reference::collide(world.shape(a), {world.position(a), world.orientation(a)},
                               world.shape(b), {world.position(b), world.orientation(b)},
                               PositionType::float32)
                .separation;
        if (std::abs(separation) > kTolerance + 1e-5) {
          ASSERT_EQ(world.overlaps()[i], separation < 0) << separation;
        }
      }
      for (const Contact& contact : world.contacts()) {
        const BodyId a = world.id_of(contact.a), b = world.id_of(contact.b);
        const double separation =
            reference::collide(world.shape(a), {world.position(a), world.orientation(a)},
                               world.shape(b), {world.position(b), world.orientation(b)},
                               PositionType::float32)
                .separation;
        ASSERT_NEAR(contact.separation, separation, kTolerance + 1e-5);
      }
      for (const BodyId id : ids) {
        world.set_position(id, world.position(id) + 0.004 * random.direction());
      }
    }
  }
  EXPECT_GT(simpler, 1000u);
  EXPECT_GT(overlaps, 300u);
}

}  // namespace
}  // namespace carom::test
