// Accuracy::tolerance in worlds: what is kept, and when it is tested again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/world/crowds.h"
#include "tests/world/tolerance.h"

namespace carom::test {
namespace {

// The first step sees where bodies are, the second how fast they are: from then on results are
// kept.
void start_keeping(World& world) {
  world.step();
  world.step();
}

// A body of that shape inside a large sphere.
struct Lone {
  explicit Lone(const Shape& shape, float metres = 0.5f, PositionType positions = {})
      : world(within(metres, {.positions = positions, .persist_events = true})) {
    id = world.add({.shape = shape});
    other = world.add({.shape = Sphere{5}, .position = {1, 0, 0}});
    start_keeping(world);
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

TEST(Tolerance, IsTheWayFromTheLastTest) {
  for (const PositionType positions : {PositionType::float32, PositionType::float64}) {
    Lone lone(Sphere{1}, 0.5f, positions);
    EXPECT_FALSE(lone.is_tested_at(0.25));
    EXPECT_FALSE(lone.is_tested_at(0.49));
    EXPECT_TRUE(lone.is_tested_at(0.51));
    EXPECT_FALSE(lone.is_tested_at(0.76));
    EXPECT_TRUE(lone.is_tested_at(0.5));  // there and back
    EXPECT_TRUE(lone.is_tested_at(2));
    EXPECT_FALSE(lone.is_tested_at(2));
  }
}

// It goes nowhere, however long it does so.
TEST(Tolerance, ABodyThatTremblesIsNotTestedAgain) {
  Lone lone(Box{{1, 1, 1}}, 0.5f);
  for (int i = 0; i < 200; ++i) {
    EXPECT_FALSE(lone.is_tested_at(i % 2 ? 0.007 : -0.007));
    EXPECT_FALSE(lone.is_tested_turned(i % 2 ? 0.002 : -0.002));
  }
}

TEST(Tolerance, CountsTheTurn) {
  Lone lone(Box{{2, 0.1f, 0.1f}});  // a point moves by about 2 m a radian
  EXPECT_FALSE(lone.is_tested_turned(0.12));
  EXPECT_FALSE(lone.is_tested_turned(0.12, -1));
  EXPECT_FALSE(lone.is_tested_turned(0.12, -30));
  EXPECT_FALSE(lone.is_tested_turned(0.24, 0.001));
  EXPECT_TRUE(lone.is_tested_turned(0.26, 1000));
  EXPECT_TRUE(lone.is_tested_turned(3));
  // Shift and rotation add up.
  EXPECT_FALSE(lone.is_tested_turned(3.1));
  EXPECT_FALSE(lone.is_tested_at(0.28));
  EXPECT_TRUE(lone.is_tested_at(0.32));
}

TEST(Tolerance, ABallDoesNotTurn) {
  Lone lone(Sphere{1});
  lone.world.add({.shape = Box{}, .position = {50, 0, 0}});
  EXPECT_FALSE(lone.is_tested());
  lone.world.arrays().orientation[4 * lone.id.index] = 5;
  EXPECT_FALSE(lone.is_tested());
}

// A rotation moves far points of a half-space by any distance.
TEST(Tolerance, AHalfspaceMayShiftButNotTurn) {
  Lone lone(Halfspace{{1, 0, 0}, 0});
  EXPECT_FALSE(lone.is_tested_at(0.2));
  EXPECT_TRUE(lone.is_tested_turned(1e-3));
  EXPECT_FALSE(lone.is_tested_turned(1e-3));
}

TEST(Tolerance, WhatIsAnotherBodyIsTestedAgain) {
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

TEST(Tolerance, ABodyThatWasSpoiltIsTestedAgain) {
  Lone lone(Box{{1, 1, 1}});
  lone.world.set_position(lone.id, {NAN, 0, 0});
  EXPECT_EQ(lone.world.step().pairs, 0u);
  EXPECT_TRUE(lone.is_tested_at(0));
  lone.world.set_orientation(lone.id, {0, 0, 0, 0});
  EXPECT_EQ(lone.world.step().pairs, 0u);
  EXPECT_TRUE(lone.is_tested_turned(0));
}

// Bounds hold a body for some steps once it is known how fast it creeps.
TEST(Tolerance, BoundsHoldABodyThatCreeps) {
  Lone lone(Sphere{1}, 0.1f);
  int steps_with_bounds = 0;
  for (int i = 1; i <= 100; ++i) {
    lone.world.set_position(lone.id, {0.001 * i, 0, 0});
    lone.world.step();
    steps_with_bounds += lone.world.report().ran(Stage::bounds);
  }
  EXPECT_GT(steps_with_bounds, 1);
  EXPECT_LT(steps_with_bounds, 5);
  EXPECT_FALSE(lone.is_tested());
  EXPECT_FALSE(lone.world.report().ran(Stage::bounds));
}

// However large the tolerance is: bounds that are separate make no pair.
TEST(Tolerance, APairEndsWithItsBounds) {
  World world(within(100));
  const BodyId id = world.add({.shape = Sphere{1}});
  world.add({.shape = Sphere{1}, .position = {1.9, 0, 0}});
  start_keeping(world);
  EXPECT_EQ(world.report().overlaps, 1u);
  world.set_position(id, {-0.05, 0, 0});
  EXPECT_EQ(world.step().kept, 1u);
  world.set_position(id, {-0.2, 0, 0});
  EXPECT_EQ(world.step().pairs, 0u);
  ASSERT_EQ(world.events().size(), 1u);
  EXPECT_EQ(world.events()[0].kind, EventKind::end);
  world.set_position(id, {0, 0, 0});
  EXPECT_EQ(world.step().tested, 1u);
}

// A pair that is apart needs no test until its gap and the tolerance are used up.
TEST(Tolerance, AGapIsAddedToIt) {
  World world(within(0.1f));
  const BodyId id = world.add({.shape = Box{{1, 1, 1}}});
  world.add({.shape = Box{{1, 1, 1}},
             .position = {2.3, 2.3, 0},
             .orientation = Orientation(Eigen::AngleAxisf(0.785398f, Eigen::Vector3f::UnitZ()))});
  start_keeping(world);
  EXPECT_EQ(world.report().pairs, 1u);
  EXPECT_EQ(world.report().overlaps, 0u);
  const double gap = 2.3 * std::sqrt(2.0) - std::sqrt(2.0) - 1;
  const auto move = [&](double way) -> const StepReport& {
    const double part = way / std::sqrt(2.0);
    world.set_position(id, {part, part, 0});
    return world.step();
  };
  // The gap is measured once it is known how fast the bodies come nearer.
  size_t tested = 0;
  double way = 0;
  for (; way + 0.01 < gap + 0.09; way += 0.01) {
    tested += move(way).tested;
    EXPECT_EQ(world.report().overlaps, 0u);
  }
  EXPECT_LT(tested, 4u);
  EXPECT_EQ(move(gap + 0.11).tested, 1u);
  EXPECT_EQ(world.report().overlaps, 1u);
}

// A body behind a one-sided triangle is not near: a little way may bring it to the front.
TEST(Tolerance, WhatIsBehindATriangleIsTestedOnceItHasMoved) {
  World world(within(0.1f));
  world.add({.shape = Triangle{.corners = {Eigen::Vector3f{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}},
                               .one_sided = true}});
  const BodyId id = world.add({.shape = Sphere{1}, .position = {0, 0, -0.01}});
  start_keeping(world);
  EXPECT_EQ(world.report().pairs, 1u);
  EXPECT_EQ(world.report().overlaps, 0u);
  world.set_position(id, {0, 0, 0.08});
  EXPECT_EQ(world.step().tested, 0u);
  world.set_position(id, {0, 0, 0.1});
  EXPECT_EQ(world.step().tested, 1u);
  EXPECT_EQ(world.report().overlaps, 1u);
}

// Half of the tolerance of each of the two counts.
TEST(Tolerance, OfABodyReplacesThatOfTheWorld) {
  World world(within(0.1f));
  const BodyId a = world.add({.shape = Sphere{1}, .tolerance = 0.0f});
  const BodyId b = world.add({.shape = Sphere{1}, .position = {1, 0, 0}, .tolerance = 0.5f});
  EXPECT_EQ(world.tolerance(a), 0.0f);
  start_keeping(world);
  world.set_position(a, {0.24, 0, 0});
  EXPECT_EQ(world.step().tested, 0u);
  world.set_position(b, {1.02, 0, 0});
  EXPECT_EQ(world.step().tested, 1u);
  world.set_tolerance(a, std::nullopt);
  EXPECT_EQ(world.tolerance(a), std::nullopt);
  EXPECT_EQ(world.step().tested, 1u);
  world.set_position(a, {0.53, 0, 0});
  EXPECT_EQ(world.step().tested, 0u);
  world.set_position(a, {0.55, 0, 0});
  EXPECT_EQ(world.step().tested, 1u);

  // Also in a world that has none.
  World plain(WorldSettings{});
  const BodyId own = plain.add({.shape = Sphere{1}, .tolerance = 0.2f});
  plain.add({.shape = Sphere{1}, .position = {1, 0, 0}});
  start_keeping(plain);
  plain.set_position(own, {0.09, 0, 0});
  EXPECT_EQ(plain.step().tested, 0u);
  plain.set_position(own, {0.11, 0, 0});
  EXPECT_EQ(plain.step().tested, 1u);
}

// The row of a removed body is gone, even where no bounds are made anew.
TEST(Tolerance, ARemovedBodyIsGone) {
  World world(within(0.1f));
  world.add({.shape = Sphere{1}});
  const BodyId last = world.add({.shape = Sphere{1}, .position = {1, 0, 0}});
  const BodyId invalid = world.add({.shape = Sphere{-1}});
  for (int i = 0; i < 3; ++i) world.step();
  EXPECT_EQ(world.quarantined().size(), 1u);
  world.remove(invalid);
  world.remove(last);
  EXPECT_EQ(world.step().pairs, 0u);
  EXPECT_EQ(world.events().size(), 1u);
  EXPECT_TRUE(world.quarantined().empty());
  const float inside[3] = {1.5f, 0, 0};
  std::vector<PointHit> hits;
  world.find_points(inside, 1, sizeof inside, hits);
  EXPECT_TRUE(hits.empty());
}

double error_of_only_pair(const World& world, BodyId a, BodyId b) {
  const double separation = true_separation(world, {a.index, b.index});
  const bool overlap = !world.pairs().empty() && world.overlaps()[0] == 1;
  if (!overlap) return std::max(0.0, -separation);
  return std::abs(world.contacts()[0].separation - separation);
}

TEST(Tolerance, HalfspacesMayRise) {
  for (const double pace : {0.02, 0.04, 0.1, 0.5, 2.0}) {  // of the tolerance
    World world(within(0.1f));
    const BodyId ground = world.add({.shape = Halfspace{{0, 0, 1}, 0}});
    const BodyId ball = world.add({.shape = Sphere{0.5f}, .position = {0, 0, 3}});
    for (int i = 0; i < 120; ++i) {
      world.set_position(ground, {0, 0, 0.1 * pace * i});
      world.step();
      ASSERT_LE(error_of_only_pair(world, ground, ball), 0.1001) << pace << ", " << i;
    }
  }
}

// Tolerances, gaps and jumps that are many times the tolerance by which ticks are measured.
TEST(Tolerance, AJumpIsSeenWhateverTheTolerance) {
  for (const float least : {1e-6f, 1e-30f}) {
    World world(within(least));
    const BodyId a = world.add({.shape = Sphere{100}, .tolerance = 1.0f});
    const BodyId b = world.add({.shape = Sphere{100}, .position = {150, 0, 0}, .tolerance = 1.0f});
    start_keeping(world);
    for (const double x : {190, 110}) {
      world.set_position(b, {x, 0, 0});
      world.step();
      EXPECT_LE(error_of_only_pair(world, a, b), 1.001);
    }
  }
  for (const float size : {5.0f, 5000.0f}) {
    const float tolerance = size == 5 ? 1e-6f : 1e-3f;
    World world(within(tolerance, {.positions = PositionType::float64}));
    const Capsule stick{{-size, -size, 0}, {size, size, 0}, size / 5000};
    const BodyId a = world.add({.shape = stick});
    const BodyId b = world.add({.shape = stick, .position = {0.4 * size, 0, 0}});
    for (int i = 0; i < 4; ++i) {
      world.set_position(b, {0.4 * size + 0.001 * size * i, 0, 0});
      world.step();
    }
    world.set_position(b, {0.0001 * size, 0, 0});
    world.step();
    EXPECT_EQ(world.report().overlaps, 1u);
    EXPECT_LE(error_of_only_pair(world, a, b), tolerance + 1e-4 * size);
  }
}

TEST(Tolerance, QuaternionsHaveAnyLength) {
  for (int exponent = -36; exponent <= 36; exponent += 2) {
    const double length = std::pow(10.0, exponent);
    const auto turned = [&](double angle) {
      return Orientation(static_cast<float>(length * std::cos(angle)), 0, 0,
                         static_cast<float>(length * std::sin(angle)));
    };
    World world(within(1e-3f));
    const BodyId rod = world.add({.shape = Box{{10, 0.1f, 0.1f}}, .orientation = turned(0)});
    const BodyId ball = world.add({.shape = Sphere{0.5f}, .position = {9, 0.65, 0}});
    for (int i = 0; i < 40; ++i) {
      world.set_orientation(rod, turned(0.001 * i));
      world.step();
      ASSERT_LE(error_of_only_pair(world, rod, ball), 1.1e-3) << exponent << ", " << i;
    }
  }
}

// Limits of an older list of pairs are not those of this one.
TEST(Tolerance, LimitsOfOtherPairsAreForgotten) {
  World world(within(0.1f, {.positions = PositionType::float64, .detail = Detail::regions}));
  std::array<BodyId, 4> ids;
  for (int i = 0; i < 4; ++i) {
    ids[i] = world.add({.shape = Sphere{1}, .position = {i < 2 ? i : 20.0 * i, 0, 0}});
  }
  start_keeping(world);
  for (int k = 0; k < 2; ++k) {
    world.set_shape(ids[0], Sphere{1});
    world.set_shape(ids[1], Sphere{1});
    world.step();
  }
  // Steps that look ahead hold on to nothing. In them two bodies part, and two others meet.
  world.set_detection(ids[0], Detection::swept);
  world.step();
  world.set_position(ids[1], {-50, 0, 0});
  for (int i = 0; i < 3; ++i) {
    world.set_position(ids[2], {58.4 + 0.01 * i, 0, 0});
    world.set_linear_velocity(ids[0], {static_cast<float>(i), 0, 0});
    world.step();
  }
  world.set_detection(ids[0], Detection::discrete);
  for (const double x : {58.8, 59.0, 59.4, 59.8}) {
    world.set_position(ids[2], {x, 0, 0});
    world.step();
    ASSERT_EQ(world.contacts().size(), 1u);
    EXPECT_NEAR(world.contacts()[0].separation, std::abs(60 - x) - 2, 0.1001);
  }
}

// Neither a tolerance of 0 of some bodies nor a tolerance much larger than they are makes bounds
// huge.
TEST(Tolerance, BoundsStayAsLargeAsTheBodies) {
  for (const float of_world : {0.0f, 0.1f, 10.0f, 1000.0f, 1e6f, 1e30f, 3e38f}) {
    World world(within(of_world));
    std::vector<BodyId> ids;
    // It has no size, and is below all.
    world.add({.shape = Halfspace{{0, 0, 1}, -10}});
    for (int i = 0; i < 200; ++i) {
      ids.push_back(world.add({.shape = Sphere{0.4f}, .position = {static_cast<double>(i), 0, 0}}));
      if (of_world == 0) world.set_tolerance(ids.back(), 0.0f);
    }
    for (int k = 0; k < 20; ++k) {
      for (int i = 0; i < 200; ++i) world.set_position(ids[i], {i + 1e-3 * k, 0, 0});
      world.step();
      ASSERT_LE(world.pairs().size(), of_world == 0 ? 0u : 199u) << of_world << ", " << k;
    }
  }
}

TEST(Tolerance, ThatIsNoLengthIsAnError) {
  World world(within(0.1f));
  const BodyId id = world.add({.shape = Sphere{1}, .tolerance = 0.2f});
  for (const float bad : {-1.0f, -1e-30f, NAN, INFINITY, -INFINITY}) {
    EXPECT_THROW(World(within(bad)), std::invalid_argument) << bad;
    const BodyDesc good = {.shape = Sphere{1}}, wrong = {.shape = Sphere{1}, .tolerance = bad};
    EXPECT_THROW(world.add(wrong), std::invalid_argument) << bad;
    std::vector<BodyId> ids;
    EXPECT_THROW(world.add(std::vector{good, wrong}, ids), std::invalid_argument) << bad;
    EXPECT_TRUE(ids.empty());
    EXPECT_THROW(world.set_tolerance(id, bad), std::invalid_argument) << bad;
  }
  EXPECT_EQ(world.size(), 1u);
  EXPECT_EQ(world.tolerance(id), 0.2f);
  try {
    world.set_tolerance(id, -2.0f);
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "the tolerance -2.000000 is not a finite number of metres from 0 on");
  }
}

// Bodies get tolerances, and lose them, at any time.
TEST(Tolerance, IsThereOnceABodyHasOne) {
  World world(within(0));
  const BodyId a = world.add({.shape = Sphere{1}, .tolerance = 0.0f});
  world.add({.shape = Sphere{1}, .position = {1, 0, 0}});
  const auto is_kept = [&](double x) {
    world.set_position(a, {x, 0, 0});
    return world.step().kept == 1;
  };
  EXPECT_FALSE(is_kept(0) || is_kept(0.001) || is_kept(0.002));
  world.set_tolerance(a, 0.2f);
  start_keeping(world);
  EXPECT_TRUE(is_kept(0.003));
  world.set_tolerance(a, std::nullopt);
  EXPECT_FALSE(is_kept(0.004) || is_kept(0.005));
}

// Odometers jump whenever the world looks whether bodies are slow, and pass their greatest number.
TEST(Tolerance, HoldsAfterManyStartsThatFailed) {
  for (const int starts : {3, 4, 7, 8, 11, 15, 16}) {
    World world(within(0.02f));
    std::vector<BodyId> ids;
    for (int i = 0; i < 12; ++i) {
      ids.push_back(world.add({.shape = Sphere{0.6f}, .position = {static_cast<double>(i), 0, 0}}));
    }
    const auto move_to = [&](double way) {
      for (size_t i = 0; i < ids.size(); ++i) {
        const double own = i % 2 == 0 ? way : -way;
        world.set_position(ids[i], {static_cast<double>(i), own, 0});
      }
      world.step();
    };
    for (int i = 0; i < 140 * starts; ++i) move_to(i % 2);
    for (int i = 0; i < 300; ++i) {
      move_to(0.002 * i);
      for (const Contact& contact : world.contacts()) {
        ASSERT_NEAR(contact.separation, true_separation(world, {contact.a, contact.b}), 0.0201);
      }
      const double between = std::hypot(1, 0.004 * i) - 1.2;
      if (std::abs(between) > 0.021) {
        ASSERT_EQ(world.report().overlaps > 0, between < 0) << starts << ", " << i;
      }
    }
  }
}

TEST(Tolerance, TakesNoMemoryAtDetailPairs) {
  size_t bytes[2];
  for (const bool set : {false, true}) {
    World world(within(set ? 1.0f : 0.0f, {.detail = Detail::pairs}));
    add_crowd(world, {.oriented = true});
    for (int i = 0; i < 3; ++i) world.step();
    bytes[set] = world.bytes();
  }
  EXPECT_EQ(bytes[1], bytes[0]);
}

}  // namespace
}  // namespace carom::test
