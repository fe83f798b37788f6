// Begin, persist and end; sensors; removal and replacement; quarantine and recovery.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "carom/world/world.h"

namespace carom::test {
namespace {

using ::testing::ElementsAre;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct Told {
  EventKind kind;
  BodyId a, b;
  bool sensor = false;
  bool contact = false;
  bool operator==(const Told&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Told& t) {
  return out << "kind " << static_cast<int>(t.kind) << ", " << t.a.index << "." << t.a.generation
             << " and " << t.b.index << "." << t.b.generation << (t.sensor ? ", sensor" : "")
             << (t.contact ? ", contact" : "");
}

// Steps and returns the events; checks that their contact indices are right.
std::vector<Told> told(World& world) {
  world.step();
  std::vector<Told> all;
  for (const Event& event : world.events()) {
    EXPECT_EQ(event.reserved, 0);
    if (event.contact != kNoContact) {
      const Contact& contact = world.contacts()[event.contact];
      EXPECT_EQ(contact.a, event.a.index);
      EXPECT_EQ(contact.b, event.b.index);
    }
    all.push_back({event.kind, event.a, event.b, event.sensor, event.contact != kNoContact});
  }
  return all;
}

Told begin(BodyId a, BodyId b) { return {EventKind::begin, a, b, false, true}; }
Told persist(BodyId a, BodyId b) { return {EventKind::persist, a, b, false, true}; }
Told end(BodyId a, BodyId b) { return {EventKind::end, a, b}; }

Told sensed(Told told) {
  told.sensor = true;
  told.contact = false;
  return told;
}

class Events : public ::testing::TestWithParam<bool> {
 protected:
  Events() {
    WorldSettings settings;
    settings.carry_results = GetParam();
    world = World(settings);
  }
  BodyId ball(double x) { return world.add({.shape = Sphere{0.5f}, .position = {x, 0, 0}}); }
  void move(BodyId id, double x) { world.set_position(id, {x, 0, 0}); }

  World world;
};

INSTANTIATE_TEST_SUITE_P(CarryResults, Events, ::testing::Bool());

TEST_P(Events, BeginPersistEnd) {
  const BodyId a = ball(0), b = ball(0.5);
  EXPECT_THAT(told(world), ElementsAre(begin(a, b)));
  EXPECT_THAT(told(world), ElementsAre(persist(a, b)));
  move(b, 0.75);
  EXPECT_THAT(told(world), ElementsAre(persist(a, b)));
  move(b, 5);
  EXPECT_THAT(told(world), ElementsAre(end(a, b)));
  EXPECT_THAT(told(world), ElementsAre());
  move(b, 1);
  EXPECT_THAT(told(world), ElementsAre(begin(a, b))) << "touching is overlap";
}

TEST_P(Events, BoundsThatOverlapAreNoOverlap) {
  const BodyId a = ball(0);
  const BodyId b = world.add({.shape = Sphere{0.5f}, .position = {0.9, 0.9, 0}});
  EXPECT_THAT(told(world), ElementsAre());
  EXPECT_EQ(world.pairs().size(), 1u);
  move(b, 0.5);
  EXPECT_THAT(told(world), ElementsAre(begin(a, b)));
  world.set_position(b, {0.9, 0.9, 0});
  EXPECT_THAT(told(world), ElementsAre(end(a, b)));
  EXPECT_EQ(world.pairs().size(), 1u);
}

TEST_P(Events, SensorsHaveEventsAndNoContacts) {
  const BodyId a = ball(0), b = ball(0.5);
  world.set_sensor(a, true);
  EXPECT_THAT(told(world), ElementsAre(sensed(begin(a, b))));
  EXPECT_TRUE(world.contacts().empty());
  EXPECT_THAT(told(world), ElementsAre(sensed(persist(a, b))));
  world.set_sensor(a, false);
  EXPECT_THAT(told(world), ElementsAre(persist(a, b)));
  world.set_sensor(b, true);
  EXPECT_THAT(told(world), ElementsAre(sensed(persist(a, b))));
  move(a, 9);
  EXPECT_THAT(told(world), ElementsAre(sensed(end(a, b))));
}

TEST_P(Events, RemovedBodiesEnd) {
  const BodyId a = ball(0), b = ball(0.5), c = ball(-0.5);
  EXPECT_THAT(told(world), ElementsAre(begin(a, b), begin(a, c), begin(b, c)));
  world.remove(a);
  EXPECT_THAT(told(world), ElementsAre(end(a, b), end(a, c), persist(b, c)));
  world.remove(b);
  world.remove(c);
  EXPECT_THAT(told(world), ElementsAre(end(b, c)));
  EXPECT_THAT(told(world), ElementsAre());
}

TEST_P(Events, AnotherBodyAtTheSameIndexIsAnotherBody) {
  const BodyId a = ball(0), b = ball(0.5), c = ball(0.75);
  EXPECT_THAT(told(world), ElementsAre(begin(a, b), begin(a, c), begin(b, c)));
  world.remove(b);
  const BodyId next = ball(0.5);
  ASSERT_EQ(next.index, b.index);
  EXPECT_THAT(told(world),
              ElementsAre(end(a, b), begin(a, next), persist(a, c), end(b, c), begin(next, c)));
  EXPECT_THAT(told(world), ElementsAre(persist(a, next), persist(a, c), persist(next, c)));
}

TEST_P(Events, ReplacedTwiceBetweenSteps) {
  const BodyId a = ball(0), b = ball(0.5);
  told(world);
  world.remove(b);
  const BodyId never_seen = ball(0.5);
  world.remove(never_seen);
  const BodyId next = ball(0.5);
  EXPECT_EQ(next.generation, b.generation + 2);
  EXPECT_THAT(told(world), ElementsAre(end(a, b), begin(a, next)));
  world.remove(next);
  ball(0.5);
  world.remove({b.index, next.generation + 1});
  EXPECT_THAT(told(world), ElementsAre(end(a, next)));
}

TEST_P(Events, FiltersEndOverlaps) {
  const BodyId a = ball(0), b = ball(0.5);
  told(world);
  world.set_filter(b, 1, 0, 0);
  EXPECT_THAT(told(world), ElementsAre(end(a, b)));
  world.set_filter(b, 1, 1, 0);
  EXPECT_THAT(told(world), ElementsAre(begin(a, b)));
}

TEST_P(Events, QuarantineAndRecovery) {
  const BodyId a = ball(0), b = ball(0.5);
  EXPECT_THAT(told(world), ElementsAre(begin(a, b)));
  world.set_position(b, {kNan, 0, 0});
  EXPECT_THAT(told(world), ElementsAre(end(a, b)));
  EXPECT_THAT(world.quarantined(), ElementsAre(b));
  EXPECT_EQ(world.report().quarantined, 1u);
  EXPECT_EQ(world.report().bodies, 2u);
  EXPECT_THAT(told(world), ElementsAre());
  EXPECT_THAT(world.quarantined(), ElementsAre(b)) << "still";
  move(a, 0.25);
  EXPECT_THAT(told(world), ElementsAre());
  EXPECT_THAT(world.quarantined(), ElementsAre(b));
  move(b, 0.5);
  EXPECT_THAT(told(world), ElementsAre(begin(a, b)));
  EXPECT_TRUE(world.quarantined().empty());
}

TEST_P(Events, EveryKindOfBadBodyIsQuarantined) {
  const float infinity = std::numeric_limits<float>::infinity();
  const BodyId a = ball(0), b = ball(0.5);
  const auto expect_bad = [&] {
    told(world);
    EXPECT_THAT(world.quarantined(), ElementsAre(b));
    EXPECT_TRUE(world.pairs().empty());
  };
  for (const float radius : {-1.0f, infinity, static_cast<float>(kNan)}) {
    world.set_shape(b, Sphere{radius});
    expect_bad();
  }
  world.set_shape(b, Aabb{{1, 0, 0}, {0, 1, 1}});
  expect_bad();
  world.set_shape(b, Aabb{{0, 0, 0}, {1, infinity, 1}});
  expect_bad();
  world.set_shape(b, Sphere{0.5f});
  world.set_position(b, {0, infinity, 0});
  expect_bad();
  world.set_position(b, {1e39, 0, 0});  // beyond the range of float32
  expect_bad();
  move(b, 0.5);
  EXPECT_THAT(told(world), ElementsAre(begin(a, b)));
  world.remove(b);
  told(world);
  EXPECT_TRUE(world.quarantined().empty());
}

TEST_P(Events, QuarantinedAreSortedAndRemovedOnesAreNot) {
  std::vector<BodyId> ids;
  for (int i = 0; i < 6; ++i) ids.push_back(ball(i % 2 ? kNan : i));
  told(world);
  EXPECT_THAT(world.quarantined(), ElementsAre(ids[1], ids[3], ids[5]));
  world.remove(ids[3]);
  told(world);
  EXPECT_THAT(world.quarantined(), ElementsAre(ids[1], ids[5]));
}

TEST(EventSettings, WithoutEventsThereAreNone) {
  WorldSettings settings;
  settings.events = false;
  World world(settings);
  world.add({.shape = Sphere{1}});
  world.add({.shape = Sphere{1}});
  world.step();
  EXPECT_EQ(world.contacts().size(), 1u);
  EXPECT_TRUE(world.events().empty());
  EXPECT_FALSE(world.report().ran(Stage::events));
}

TEST(EventSettings, AtDetailOverlapTheyNameNoContact) {
  WorldSettings settings;
  settings.detail = Detail::overlap;
  World world(settings);
  world.add({.shape = Sphere{1}});
  world.add({.shape = Sphere{1}, .sensor = true});
  world.add({.shape = Sphere{1}});
  world.step();
  EXPECT_EQ(world.report().overlaps, 3u);
  EXPECT_TRUE(world.contacts().empty());
  ASSERT_EQ(world.events().size(), 3u);
  for (const Event& event : world.events()) {
    EXPECT_EQ(event.kind, EventKind::begin);
    EXPECT_EQ(event.contact, kNoContact);
    EXPECT_EQ(event.sensor, event.a.index == 1 || event.b.index == 1);
  }
}

}  // namespace
}  // namespace carom::test
