// Impacts from step to step: events, steps that repeat the last one, bodies that are added and
// removed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/world/crowds.h"
#include "tests/world/motion/bullets.h"

namespace carom::test {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(ImpactSteps, EventsFollowThoseOfOverlaps) {
  WorldSettings settings = kSecond;
  settings.persist_events = true;
  World world(settings);
  world.add(wall(10));
  world.add({.shape = Sphere{1}, .position = {5, 0, 0}, .sensor = true});
  const BodyId b = world.add(bullet(100));
  const BodyId c = world.add({.shape = Sphere{1}, .position = {0, 90, 0}});
  const BodyId d = world.add({.shape = Sphere{1}, .position = {0, 91, 0}});
  for (const EventKind expected : {EventKind::begin, EventKind::persist, EventKind::persist}) {
    world.step();
    ASSERT_THAT(world.events(), SizeIs(3)) << "a still step has them all again";
    EXPECT_EQ(world.events()[0].kind, expected);
    EXPECT_EQ(world.events()[0].a, c);
    EXPECT_EQ(world.events()[0].b, d);
    for (uint32_t i = 0; i < 2; ++i) {
      const Event& event = world.events()[1 + i];
      EXPECT_EQ(event.kind, EventKind::impact);
      EXPECT_EQ(event.contact, i);
      EXPECT_EQ(event.a.index, world.impacts()[i].a);
      EXPECT_EQ(event.b, b);
      EXPECT_EQ(event.sensor, i == 0);
    }
  }
  WorldSettings quiet = kSecond;
  quiet.events = false;
  World without(quiet);
  without.add(wall(10));
  without.add(bullet(100));
  EXPECT_THAT(step(without), SizeIs(1));
  EXPECT_THAT(without.events(), IsEmpty());
}

// A step that repeats the last one searches nothing again; a step after a change of motion is no
// repetition.
TEST(ImpactSteps, StillStepsRepeatThem) {
  World world(kSecond);
  const BodyId w = world.add(wall(10));
  const BodyId b = world.add(bullet(100));
  const auto runs = [&] {
    world.step();
    return world.report().ran(Stage::impacts);
  };
  EXPECT_TRUE(runs());
  const std::string before = as_bytes(world.impacts());
  EXPECT_FALSE(runs());
  EXPECT_EQ(as_bytes(world.impacts()), before);
  EXPECT_EQ(world.report().impacts, 1u);
  EXPECT_EQ(world.report().swept, 1u);
  world.linear_velocities()[b.index].x() = 50;
  EXPECT_TRUE(runs());
  EXPECT_NE(as_bytes(world.impacts()), before);
  EXPECT_FALSE(runs());
  world.linear_velocities()[w.index].x() = 1;
  EXPECT_TRUE(runs()) << "the other one moves";
  world.angular_velocities()[w.index].x() = 1;
  EXPECT_TRUE(runs());
  world.set_dt(2);
  EXPECT_TRUE(runs());
  EXPECT_FALSE(runs());
  world.set_detection(b, Detection::swept);
  EXPECT_TRUE(runs());
  EXPECT_THAT(world.impacts(), IsEmpty());
  world.set_detection(b, Detection::discrete);
  EXPECT_FALSE(runs());
  EXPECT_THAT(world.pairs(), IsEmpty());
  EXPECT_THAT(world.events(), IsEmpty());
}

TEST(ImpactSteps, WithoutCarryingTheyAreFoundEveryTime) {
  WorldSettings settings = kSecond;
  settings.carry_results = false;
  World world(settings);
  world.add(wall(10));
  world.add(bullet(100));
  for (int i = 0; i < 3; ++i) {
    EXPECT_THAT(step(world), SizeIs(1));
    EXPECT_TRUE(world.report().ran(Stage::impacts));
  }
}

TEST(ImpactSteps, BodiesThatWentMeetNothing) {
  World world(kSecond);
  const BodyId w = world.add(wall(10));
  const BodyId b = world.add(bullet(100));
  EXPECT_THAT(step(world), SizeIs(1));
  world.remove(w);
  const BodyId next = world.add(wall(20));
  ASSERT_EQ(next.index, w.index);
  EXPECT_EQ(world.first_impact(next), nullptr) << "it was not there in the last step";
  EXPECT_NE(world.first_impact(b), nullptr);
  EXPECT_THAT(step(world), SizeIs(1));
  EXPECT_NEAR(world.impacts()[0].toi, 0.2, 1e-3);
  EXPECT_EQ(world.events()[0].a, next);
  world.remove(b);
  EXPECT_THAT(step(world), IsEmpty());
  EXPECT_EQ(world.first_impact(next), nullptr);
  const BodyId last = world.add(bullet(5));
  EXPECT_EQ(world.first_impact(last), nullptr);
  world.set_position(next, {4, 0, 0});
  EXPECT_THAT(step(world), SizeIs(1));
}

TEST(ImpactSteps, MotionsThatAreNotFiniteDisturbNobody) {
  World world(kSecond), expected(kSecond);
  for (World* w : {&world, &expected}) {
    w->add(bullet(100));
    w->add(wall(10));
  }
  BodyDesc spoilt = bullet(NAN);
  spoilt.position = {10, 0, 0};
  const BodyId bad = world.add(spoilt);
  EXPECT_EQ(step(world), step(expected));
  EXPECT_EQ(as_bytes(world.impacts()), as_bytes(expected.impacts()));
  EXPECT_EQ(world.first_impact(bad), nullptr);
  EXPECT_EQ(world.report().unswept, 1u);
  EXPECT_EQ(world.report().overlaps, 1u) << "it is in the wall, and a contact";
  EXPECT_THAT(world.quarantined(), IsEmpty());
}

TEST(ImpactSteps, QuarantinedBodiesMeetNothing) {
  World world(kSecond);
  BodyDesc b = bullet(100);
  b.shape = Sphere{-1};
  world.add(b);
  world.add(wall(10));
  EXPECT_THAT(step(world), IsEmpty());
  EXPECT_EQ(world.report().quarantined, 1u);
}

TEST(ImpactSteps, DetailSaysHowMuchThereIs) {
  for (const Detail detail : {Detail::pairs, Detail::overlap, Detail::contact, Detail::manifold}) {
    WorldSettings settings = kSecond;
    settings.detail = detail;
    World world(settings);
    const BodyId b = world.add(bullet(100));
    world.add(wall(10));
    world.step();
    EXPECT_THAT(world.pairs(), SizeIs(1)) << "what it may reach";
    EXPECT_EQ(world.report().ran(Stage::impacts), detail != Detail::pairs);
    ASSERT_THAT(world.impacts(), SizeIs(detail != Detail::pairs));
    if (detail == Detail::pairs) continue;
    EXPECT_NEAR(world.first_impact(b)->toi, 0.1, 1e-3);
    EXPECT_EQ(world.impacts()[0].normal.isZero(0), detail == Detail::overlap);
  }
}

TEST(ImpactSteps, TooManyPairsAreNone) {
  WorldSettings settings = kSecond;
  settings.most_pairs = 1;
  World world(settings);
  world.add(bullet(100));
  world.add(wall(10));
  world.add(wall(20));
  EXPECT_THAT(step(world), IsEmpty());
  EXPECT_FALSE(world.report().search.complete);
  EXPECT_THAT(world.pairs(), IsEmpty());
}

}  // namespace
}  // namespace carom::test
