// FastKnobs::motion_tolerance: which results are kept, and how far they may be off.
#include <gtest/gtest.h>

#include <cmath>

#include "carom/base/thread_arena.h"
#include "carom/reference/reference.h"
#include "tests/support/rounds.h"
#include "tests/world/side_by_side.h"

namespace carom::test {
namespace {

FastKnobs tolerance(float metres) { return {.motion_tolerance = metres}; }

WorldSettings settings_for(uint64_t seed) {
  WorldSettings settings = varied_settings(seed);
  if (seed % 7 == 0) settings.margin = 0.1f;
  if (seed % 7 == 1) settings.dop_bounds = DopKind::k14;
  return settings;
}

double true_separation(const World& world, Pair pair) {
  const BodyId a = world.id_of(pair.a), b = world.id_of(pair.b);
  return reference::collide(world.shape(a), {world.position(a), world.orientation(a)},
                            world.shape(b), {world.position(b), world.orientation(b)},
                            world.settings().positions)
      .separation;
}

// Checks every decision and separation against the present poses.
void check_error(const World& world, double most) {
  const double rounding = 2e-5;
  for (size_t i = 0; i < world.pairs().size(); ++i) {
    const double separation = true_separation(world, world.pairs()[i]);
    if (std::abs(separation) <= most + rounding) continue;
    ASSERT_EQ(world.overlaps()[i], separation < 0) << separation;
  }
  for (const Contact& contact : world.contacts()) {
    const double separation = true_separation(world, {contact.a, contact.b});
    ASSERT_NEAR(contact.separation, separation, most + rounding);
  }
}

TEST(MotionTolerance, SeparationsAreOffByTwiceTheToleranceAtMost) {
  size_t kept = 0, tested = 0;
  for (uint64_t seed = 0; seed < rounds(40); ++seed) {
    const WorldSettings standard = settings_for(seed);
    const float metres = seed % 3 == 0 ? 0.2f : 0.03f;
    SideBySide worlds(std::vector{standard, with_knobs(tolerance(metres), standard)},
                      varied_crowd(seed));
    for (int i = 0; i < 20; ++i) {
      worlds.step();
      ASSERT_EQ(as_bytes(worlds[1].pairs()), as_bytes(worlds[0].pairs()));
      ASSERT_EQ(as_bytes(worlds[1].quarantined()), as_bytes(worlds[0].quarantined()));
      check_error(worlds[1], 2 * metres);
      ASSERT_FALSE(HasFailure()) << "seed " << seed << ", step " << i;
      if (i > 0) kept += worlds[1].report().kept;
      tested += worlds[1].report().tested;
      worlds.creep(metres / 4);
      if (i % 5 == 4) worlds.disturb();
    }
  }
  EXPECT_GT(kept, tested);
}

// Includes a tolerance that no motion stays within.
TEST(MotionTolerance, OfZeroChangesNoBit) {
  for (uint64_t seed = 0; seed < rounds(20); ++seed) {
    const WorldSettings standard = settings_for(seed);
    WorldSettings anew = with_knobs(tolerance(1), standard);
    anew.carry_results = false;
    SideBySide worlds(std::vector{standard, with_knobs(tolerance(0), standard),
                                  with_knobs(tolerance(1e-30f), standard), anew},
                      varied_crowd(seed));
    for (int i = 0; i < 10; ++i) {
      worlds.step();
      for (const size_t other : {1, 2, 3}) {
        ASSERT_TRUE(results(worlds[other]) == results(worlds[0])) << other << ", step " << i;
      }
      ASSERT_EQ(worlds[1].bytes(), worlds[0].bytes());
      worlds.creep(0.05);
      if (i % 3 == 1) worlds.disturb();
    }
  }
}

TEST(MotionTolerance, TheSameOnThreads) {
  ThreadArena arena(2);
  WorldSettings threaded = with_knobs(tolerance(0.05f));
  WorldSettings plain = threaded;
  threaded.parallelism = arena.parallelism();
  plain.parallelism = Parallelism::none;
  arena.run([&] {
    SideBySide worlds(std::vector{plain, threaded}, varied_crowd(1, 5000));
    for (int i = 0; i < 6; ++i) {
      worlds.step();
      ASSERT_TRUE(results(worlds[1]) == results(worlds[0]));
      ASSERT_EQ(worlds[1].report().kept, worlds[0].report().kept);
      worlds.creep(0.02);
      worlds.disturb();
    }
    EXPECT_GT(worlds[1].report().kept, worlds[1].report().pairs / 10);
  });
}

// A body of that shape inside a large sphere.
struct Lone {
  explicit Lone(const Shape& shape, float metres = 0.5f, PositionType positions = {})
      : world(with_knobs(tolerance(metres), {.positions = positions, .persist_events = true})) {
    id = world.add({.shape = shape});
    other = world.add({.shape = Sphere{5}, .position = {1, 0, 0}});
    world.step();
  }

  bool is_tested() {
    const StepReport& report = world.step();
    EXPECT_EQ(report.pairs, 1u);
    EXPECT_EQ(report.tested + report.kept, 1u);
    return report.tested == 1;
  }
  bool is_tested_at(double x) {
    world.set_position(id, {x, 0, 0});
    return is_tested();
  }
  bool is_tested_turned(double angle, double factor = 1) {
    Eigen::Quaterniond q(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
    q.coeffs() *= factor;
    world.set_orientation(id, q.cast<float>());
    return is_tested();
  }

  World world;
  BodyId id, other;
};

TEST(MotionTolerance, HalfOfItIsTheWayFromTheLastTest) {
  for (const PositionType positions : {PositionType::float32, PositionType::float64}) {
    Lone lone(Sphere{1}, 0.5f, positions);
    EXPECT_FALSE(lone.is_tested_at(0.125));
    EXPECT_FALSE(lone.is_tested_at(-0.125));
    EXPECT_FALSE(lone.is_tested_at(0.249));
    EXPECT_TRUE(lone.is_tested_at(0.251));
    EXPECT_FALSE(lone.is_tested_at(0.125));
    EXPECT_TRUE(lone.is_tested_at(0));
    EXPECT_TRUE(lone.is_tested_at(1));
    EXPECT_FALSE(lone.is_tested_at(1));
  }
}

TEST(MotionTolerance, CountsTheTurn) {
  Lone lone(Box{{2, 0.1f, 0.1f}});  // a point moves by about 2 m a radian
  EXPECT_FALSE(lone.is_tested_turned(0.12));
  EXPECT_FALSE(lone.is_tested_turned(-0.12));
  EXPECT_FALSE(lone.is_tested_turned(0.12, -1));
  EXPECT_FALSE(lone.is_tested_turned(0.12, -30));
  EXPECT_TRUE(lone.is_tested_turned(0.127, 0.001));
  EXPECT_FALSE(lone.is_tested_turned(0.127, 1e15));
  EXPECT_TRUE(lone.is_tested_turned(3));
  // Shift and rotation add up.
  EXPECT_FALSE(lone.is_tested_turned(3.06));
  EXPECT_FALSE(lone.is_tested_at(0.12));
  EXPECT_TRUE(lone.is_tested_at(0.14));
}

TEST(MotionTolerance, ABallDoesNotTurn) {
  Lone lone(Sphere{1});
  lone.world.add({.shape = Box{}, .position = {50, 0, 0}});
  EXPECT_FALSE(lone.is_tested());
  lone.world.arrays().orientation[4 * lone.id.index] = 5;
  EXPECT_FALSE(lone.is_tested());
}

// A rotation moves far points of a half-space by any distance.
TEST(MotionTolerance, AHalfspaceMayShiftButNotTurn) {
  Lone lone(Halfspace{{1, 0, 0}, 0});
  EXPECT_FALSE(lone.is_tested_at(0.2));
  EXPECT_TRUE(lone.is_tested_turned(1e-3));
  EXPECT_FALSE(lone.is_tested_turned(1e-3));
}

TEST(MotionTolerance, WhatIsAnotherBodyIsTestedAgain) {
  Lone lone(Box{{1, 1, 1}});
  EXPECT_FALSE(lone.is_tested_at(0.1));
  lone.world.set_shape(lone.id, Box{{1, 1, 1}});
  EXPECT_TRUE(lone.is_tested());
  lone.world.shape_rows().rows[4 * lone.world.first_row(lone.id)] = 1.0001f;
  EXPECT_TRUE(lone.is_tested());
  lone.world.arrays().record32[4 * lone.other.index + 3] = 5.0001f;
  EXPECT_TRUE(lone.is_tested());
  lone.world.set_sensor(lone.id, true);
  EXPECT_TRUE(lone.is_tested());
  EXPECT_EQ(lone.world.contacts().size(), 0u);
  EXPECT_EQ(lone.world.events().size(), 1u);
  EXPECT_FALSE(lone.is_tested_at(0.11));
  lone.world.remove(lone.id);
  lone.id = lone.world.add({.shape = Box{{1, 1, 1}}, .position = {0.11, 0, 0}});
  EXPECT_TRUE(lone.is_tested());
  EXPECT_FALSE(lone.is_tested());
}

TEST(MotionTolerance, ABodyThatWasSpoiltIsTestedAgain) {
  Lone lone(Box{{1, 1, 1}});
  lone.world.set_position(lone.id, {NAN, 0, 0});
  EXPECT_EQ(lone.world.step().pairs, 0u);
  EXPECT_TRUE(lone.is_tested_at(0));
  lone.world.set_orientation(lone.id, {0, 0, 0, 0});
  EXPECT_EQ(lone.world.step().pairs, 0u);
  EXPECT_TRUE(lone.is_tested_turned(0));
}

// Bounds and pairs are those of the present poses.
TEST(MotionTolerance, AStepInWhichBodiesCreepIsNoStillOne) {
  Lone lone(Sphere{1});
  EXPECT_FALSE(lone.is_tested_at(0.1));
  EXPECT_TRUE(lone.world.report().ran(Stage::bounds));
  EXPECT_FALSE(lone.is_tested());
  EXPECT_FALSE(lone.world.report().ran(Stage::bounds));

  // A pair ends when its bounds separate, however little the bodies moved.
  World world(with_knobs(tolerance(100)));
  const BodyId id = world.add({.shape = Sphere{1}});
  world.add({.shape = Sphere{1}, .position = {1.9, 0, 0}});
  EXPECT_EQ(world.step().overlaps, 1u);
  world.set_position(id, {-0.2, 0, 0});
  EXPECT_EQ(world.step().pairs, 0u);
  ASSERT_EQ(world.events().size(), 1u);
  EXPECT_EQ(world.events()[0].kind, EventKind::end);
  world.set_position(id, {0, 0, 0});
  EXPECT_EQ(world.step().tested, 1u);
}

// Two bodies are tested at different times. Each may use up its tolerance before and after.
TEST(MotionTolerance, HoldsForBodiesThatWereTestedAtDifferentTimes) {
  World world(with_knobs(tolerance(1)));
  const BodyId a = world.add({.shape = Sphere{1}});
  const BodyId b = world.add({.shape = Sphere{1}, .position = {0.5, 0, 0}});
  world.step();
  world.set_position(a, {0.375, 0, 0});
  EXPECT_EQ(world.step().kept, 1u);
  world.set_position(b, {1.375, 0, 0});
  EXPECT_EQ(world.step().tested, 1u);  // b is a metre away from where it was tested
  EXPECT_EQ(world.contacts()[0].separation, -1);
  world.set_position(a, {-0.375, 0, 0});
  EXPECT_EQ(world.step().kept, 1u);  // a is 75 cm away from where it was tested
  EXPECT_EQ(world.contacts()[0].separation, -1);
}

TEST(MotionTolerance, TakesNoMemoryAtDetailPairs) {
  size_t bytes[2];
  for (const bool set : {false, true}) {
    World world(with_knobs(tolerance(set ? 1.0f : 0.0f), {.detail = Detail::pairs}));
    add_crowd(world, {.oriented = true});
    for (int i = 0; i < 3; ++i) world.step();
    bytes[set] = world.bytes();
  }
  EXPECT_EQ(bytes[1], bytes[0]);
}

}  // namespace
}  // namespace carom::test
