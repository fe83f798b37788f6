// Knobs of the fast tier in worlds: a knob that is off changes nothing; proxy balls.
#include <gtest/gtest.h>

#include <cmath>

#include "carom/base/thread_arena.h"
#include "tests/support/pairs.h"
#include "tests/support/rounds.h"
#include "tests/world/side_by_side.h"

namespace carom::test {
namespace {

constexpr FastKnobs kProxies{.proxy_spheres = true};

CrowdSpec crowd(uint64_t seed, size_t count = 200) {
  CrowdSpec spec = varied_crowd(seed, count);
  spec.velocities = seed % 2 == 0;
  return spec;
}

TEST(Knobs, ThatAreOffChangeNothing) {
  for (uint64_t seed = 0; seed < rounds(20); ++seed) {
    const WorldSettings standard = varied_settings(seed);
    WorldSettings ignored = standard;  // knobs count only in the fast tier
    ignored.accuracy.knobs = {.single_precision = true, .faces_only = true, .proxy_spheres = true};
    SideBySide worlds(std::vector{standard, with_knobs({}, standard), ignored}, crowd(seed));
    for (int i = 0; i < 10; ++i) {
      worlds.step();
      for (const size_t other : {1, 2}) {
        ASSERT_TRUE(results(worlds[other]) == results(worlds[0])) << "step " << i;
        ASSERT_EQ(worlds[other].report().tested, worlds[0].report().tested);
        ASSERT_EQ(worlds[other].bytes(), worlds[0].bytes());
      }
      worlds.creep(0.05);
      worlds.disturb();
    }
  }
}

// --- Proxy balls ---

// The radius of the ball about the position that contains the shape's corners.
double ball_radius(const Shape& shape) {
  const auto length = [](const Eigen::Vector3f& v) { return v.cast<double>().norm(); };
  switch (kind_of(shape)) {
    case ShapeKind::sphere:
      return std::get<Sphere>(shape).radius;
    case ShapeKind::aabb: {
      const Aabb& box = std::get<Aabb>(shape);
      return length(box.lower.cwiseAbs().cwiseMax(box.upper.cwiseAbs()));
    }
    case ShapeKind::capsule: {
      const Capsule& capsule = std::get<Capsule>(shape);
      return std::max(length(capsule.a), length(capsule.b)) + capsule.radius;
    }
    case ShapeKind::box:
      return length(std::get<Box>(shape).half);
    default: {
      const Triangle& triangle = std::get<Triangle>(shape);
      double most = 0;
      for (const Eigen::Vector3f& corner : triangle.corners) most = std::max(most, length(corner));
      return most + triangle.thickness;
    }
  }
}

// The separation of two proxy balls; NaN for half-spaces and k-DOPs.
double ball_separation(const World& world, Pair pair) {
  const BodyId a = world.id_of(pair.a), b = world.id_of(pair.b);
  for (const BodyId id : {a, b}) {
    const ShapeKind kind = kind_of(world.shape(id));
    if (kind == ShapeKind::halfspace || kind == ShapeKind::dop) return NAN;
  }
  return (world.position(b) - world.position(a)).norm() - ball_radius(world.shape(a)) -
         ball_radius(world.shape(b));
}

void check_balls(const World& balls, const World& standard, size_t& more) {
  ASSERT_EQ(as_bytes(balls.pairs()), as_bytes(standard.pairs()));
  ASSERT_EQ(as_bytes(balls.quarantined()), as_bytes(standard.quarantined()));
  for (size_t i = 0; i < balls.pairs().size(); ++i) {
    ASSERT_GE(balls.overlaps()[i], standard.overlaps()[i]) << "an overlap is lost";
    more += balls.overlaps()[i] - standard.overlaps()[i];
    const double separation = ball_separation(balls, balls.pairs()[i]);
    if (std::isnan(separation) || std::abs(separation) < 1e-5) continue;
    ASSERT_EQ(balls.overlaps()[i], separation < 0);
  }
  for (const Contact& contact : balls.contacts()) {
    const double separation = ball_separation(balls, {contact.a, contact.b});
    if (std::isnan(separation)) continue;
    ASSERT_NEAR(contact.separation, separation, 1e-5);
  }
  // Every contact of the standard world is there with balls, too, and at least as deep.
  size_t next = 0;
  for (const Contact& contact : standard.contacts()) {
    while (balls.contacts()[next].a != contact.a || balls.contacts()[next].b != contact.b) ++next;
    ASSERT_LE(balls.contacts()[next].separation, contact.separation + 1e-5);
  }
}

TEST(ProxySpheres, MissNoOverlap) {
  size_t more = 0;
  for (uint64_t seed = 0; seed < rounds(60); ++seed) {
    const WorldSettings standard = varied_settings(seed);
    SideBySide worlds(std::vector{standard, with_knobs(kProxies, standard)}, crowd(seed));
    for (int i = 0; i < 8; ++i) {
      worlds.step();
      check_balls(worlds[1], worlds[0], more);
      ASSERT_FALSE(HasFailure()) << "seed " << seed << ", step " << i;
      worlds.creep(0.05);
      worlds.disturb();
    }
  }
  EXPECT_GT(more, 1000u);
}

// Results do not depend on carrying, margins or k-DOPs.
TEST(ProxySpheres, DoNotDependOnWhatSavesTests) {
  for (uint64_t seed = 0; seed < rounds(30); ++seed) {
    const WorldSettings plain = with_knobs(kProxies, varied_settings(seed));
    WorldSettings anew = plain, margin = plain, dops = plain;
    anew.carry_results = false;
    margin.margin = 0.2f;
    dops.dop_bounds = DopKind::k18;
    SideBySide worlds(std::vector{plain, anew, margin, dops}, crowd(seed));
    for (int i = 0; i < 8; ++i) {
      worlds.step();
      ASSERT_TRUE(results(worlds[1]) == results(worlds[0])) << "seed " << seed << ", step " << i;
      ASSERT_TRUE(results(worlds[3]) == results(worlds[0])) << "seed " << seed << ", step " << i;
      ASSERT_EQ(as_bytes(worlds[2].contacts()), as_bytes(worlds[0].contacts()));
      ASSERT_EQ(as_bytes(worlds[2].events()), as_bytes(worlds[0].events()));
      worlds.creep(0.05);
      if (i % 2) worlds.disturb();
    }
  }
}

TEST(ProxySpheres, TheSameOnThreads) {
  ThreadArena arena(2);
  WorldSettings threaded = with_knobs(kProxies);
  threaded.parallelism = arena.parallelism();
  WorldSettings plain = with_knobs(kProxies);
  plain.parallelism = Parallelism::none;
  arena.run([&] {
    SideBySide worlds(std::vector{plain, threaded}, crowd(1, 5000));
    for (int i = 0; i < 4; ++i) {
      worlds.step();
      ASSERT_TRUE(results(worlds[1]) == results(worlds[0]));
      worlds.creep(0.05);
      worlds.disturb();
    }
  });
}

// The corner of one box points at the other box.
TEST(ProxySpheres, AreAboutThePosition) {
  World world(with_knobs(kProxies));
  const BodyId a = world.add({.shape = Box{{1, 2, 2}}});
  world.add({.shape = Sphere{1}, .position = {2, 2, 2}});
  world.add({.shape = Halfspace{{0, 0, 1}, -1.5f}});
  world.step();
  ASSERT_EQ(world.contacts().size(), 2u);
  EXPECT_NEAR(world.contacts()[0].separation, std::sqrt(12.0) - 4, 1e-6);
  EXPECT_NEAR(world.contacts()[1].separation, -1.5, 1e-6);
  EXPECT_EQ(world.contacts()[1].normal, Eigen::Vector3f(0, 0, -1));
  EXPECT_EQ(world.shape(a).index(), Shape(Box{}).index());
  EXPECT_EQ(world.step().kept, 2u) << "radii that are written are no change";
  EXPECT_FALSE(world.report().ran(Stage::bounds));

  // The aabb lies beside its position, so its ball is mostly empty.
  world.set_shape(a, Aabb{{0, 0, 0}, {1, 2, 2}});
  world.step();
  ASSERT_EQ(world.contacts().size(), 1u);
  EXPECT_NEAR(world.contacts()[0].separation, std::sqrt(12.0) - 4, 1e-6);
}

TEST(ProxySpheres, KeepWhatTheUserWritesInPlaceOfARadius) {
  World world(with_knobs(kProxies, {.positions = PositionType::float64}));
  const BodyId box = world.add({.shape = Box{{1, 2, 2}}});
  const BodyId ball = world.add({.shape = Sphere{1}, .position = {2, 2, 2}});
  world.arrays().record64[4 * ball.index + 3] = 1 + 0x1p-50;
  world.arrays().record64[4 * box.index + 3] = 17;
  world.step();
  EXPECT_EQ(world.arrays().record64[4 * ball.index + 3], 1 + 0x1p-50);
  ASSERT_EQ(world.contacts().size(), 1u);
  EXPECT_NEAR(world.contacts()[0].separation, std::sqrt(12.0) - 4, 1e-6);
}

TEST(ProxySpheres, OfShapesBeyondTheRangeOfFloatsMeet) {
  World world(with_knobs(kProxies));
  for (const double x : {-1e38, 1e38}) {
    world.add({.shape = Box{{3e38f, 3e38f, 3e38f}}, .position = {x, 0, 0}});
  }
  EXPECT_EQ(world.step().overlaps, 1u);
}

}  // namespace
}  // namespace carom::test
