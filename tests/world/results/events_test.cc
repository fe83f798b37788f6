// Begin, persist and end; sensors; removal and replacement; quarantine and recovery; what ends say
// about bodies that are gone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <limits>
#include <tuple>
#include <vector>

#include "carom/world/world.h"
#include "tests/world/crowds.h"

namespace carom::test {
namespace {

using ::testing::ElementsAre;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct Told {
  EventKind kind;
  BodyId a, b;
  bool sensor = false;
  bool contact = false;
  int gone = 0;
  bool operator==(const Told&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Told& t) {
  return out << "kind " << static_cast<int>(t.kind) << ", " << t.a.index << "." << t.a.generation
             << " and " << t.b.index << "." << t.b.generation << (t.sensor ? ", sensor" : "")
             << (t.contact ? ", contact" : "") << ", gone " << t.gone;
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
    all.push_back(
        {event.kind, event.a, event.b, event.sensor, event.contact != kNoContact, event.gone});
  }
  return all;
}

Told begin(BodyId a, BodyId b) { return {EventKind::begin, a, b, false, true}; }
Told persist(BodyId a, BodyId b) { return {EventKind::persist, a, b, false, true}; }
Told end(BodyId a, BodyId b, int gone = 0) { return {EventKind::end, a, b, false, false, gone}; }

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
    settings.persist_events = true;
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
  EXPECT_THAT(told(world), ElementsAre(end(a, b, kRemovedA), end(a, c, kRemovedA), persist(b, c)));
  world.remove(b);
  world.remove(c);
  EXPECT_THAT(told(world), ElementsAre(end(b, c, kRemovedA | kRemovedB)));
  EXPECT_THAT(told(world), ElementsAre());
}

// Ends follow each other whose bodies have no row any more, in arrays that were cut to what is
// left.
TEST_P(Events, AllButTheFirstBodiesAreRemovedAndMemoryIsGivenBack) {
  constexpr size_t kPairs = 500;
  std::vector<BodyId> ids;
  for (size_t i = 0; i < 2 * kPairs; ++i) {
    const double x = static_cast<double>(i / 2) * 2, z = i % 2 ? 0.1 : 0;
    ids.push_back(world.add({.shape = Sphere{0.3f}, .position = {x, 0, z}}));
  }
  EXPECT_EQ(told(world).size(), kPairs);
  world.remove(std::span(ids).subspan(2));
  world.give_back_memory();
  world.step();
  size_t ends = 0;
  for (const Event& event : world.events()) {
    if (event.kind != EventKind::end) continue;
    EXPECT_EQ(event.gone, kRemovedA | kRemovedB);
    EXPECT_EQ(event.a, ids[2 * (ends + 1)]);
    EXPECT_EQ(event.b, ids[2 * (ends + 1) + 1]);
    ++ends;
  }
  EXPECT_EQ(ends, kPairs - 1);
}

TEST_P(Events, AnotherBodyAtTheSameIndexIsAnotherBody) {
  const BodyId a = ball(0), b = ball(0.5), c = ball(0.75);
  EXPECT_THAT(told(world), ElementsAre(begin(a, b), begin(a, c), begin(b, c)));
  world.remove(b);
  const BodyId next = ball(0.5);
  ASSERT_EQ(next.index, b.index);
  EXPECT_THAT(told(world), ElementsAre(end(a, b, kRemovedB), begin(a, next), persist(a, c),
                                       end(b, c, kRemovedA), begin(next, c)));
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
  EXPECT_THAT(told(world), ElementsAre(end(a, b, kRemovedB), begin(a, next)));
  world.remove(next);
  ball(0.5);
  world.remove({b.index, next.generation + 1});
  EXPECT_THAT(told(world), ElementsAre(end(a, next, kRemovedB)));
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
  EXPECT_THAT(told(world), ElementsAre(end(a, b, kQuarantinedB)));
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

TEST_P(Events, EndsNameTheOneThatIsGone) {
  const BodyId a = ball(0), b = ball(0.5), c = ball(0.25);
  const BodyId sensor = world.add({.shape = Sphere{0.5f}, .position = {99, 0, 0}, .sensor = true});
  const BodyId ground = world.add({.shape = Halfspace{{0, 0, 1}, 0}, .position = {0, 0, -9}});
  told(world);
  move(a, kNan);
  world.remove(c);
  EXPECT_THAT(told(world), ElementsAre(end(a, b, kQuarantinedA),
                                       end(a, c, kQuarantinedA | kRemovedB), end(b, c, kRemovedB)));
  world.set_position(sensor, {0.5, 0, 0});
  world.set_position(ground, {0, 0, 0});
  EXPECT_THAT(told(world), ElementsAre(sensed(begin(b, sensor)), begin(b, ground),
                                       sensed(begin(sensor, ground))));
  world.set_shape(ground, Halfspace{{0, 0, 0}, 1});
  world.remove(sensor);
  EXPECT_THAT(told(world),
              ElementsAre(sensed(end(b, sensor, kRemovedB)), end(b, ground, kQuarantinedB),
                          sensed(end(sensor, ground, kRemovedA | kQuarantinedB))));
}

// A body that was invalid and is then removed was removed.
TEST_P(Events, RemovedGoesBeforeQuarantined) {
  const BodyId a = ball(0), b = ball(0.5);
  told(world);
  move(b, kNan);
  world.remove(b);
  const BodyId next = ball(kNan);
  ASSERT_EQ(next.index, b.index);
  EXPECT_THAT(told(world), ElementsAre(end(a, b, kRemovedB)));
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

// Begins and ends are those of a world with persist events; nothing else is there.
TEST(EventSettings, PersistOnlyIfAskedFor) {
  for (const bool carries : {false, true}) {
    World without({.carry_results = carries});
    World with({.persist_events = true, .carry_results = carries});
    size_t persists = 0;
    for (int frame = 0; frame < 40; ++frame) {
      for (World* world : {&without, &with}) {
        if (frame == 0) {
          for (int i = 0; i < 30; ++i) world->add({.shape = Sphere{0.5f}});
        }
        if (frame % 5 == 1) world->remove(world->id_of(static_cast<uint32_t>(frame / 5 + 1)));
        if (frame % 10 == 8) world->add({.shape = Sphere{0.5f}});
        for (uint32_t i = 0; i < 30 && frame % 4 != 3; ++i) {
          if (world->is_alive(i))
            world->set_position(world->id_of(i), {0.1 * (frame + 1) * i, 0, 0});
        }
        world->step();
      }
      std::vector<Event> expected;
      for (const Event& event : with.events()) {
        if (event.kind != EventKind::persist) expected.push_back(event);
      }
      persists += with.events().size() - expected.size();
      ASSERT_EQ(without.events().size(), expected.size()) << frame;
      for (size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(std::memcmp(&without.events()[i], &expected[i], sizeof(Event)), 0);
      }
    }
    EXPECT_GT(persists, 100u);
  }
}

// An overlap: indices and generations of its bodies.
using Overlap = std::array<uint32_t, 4>;

std::vector<Overlap> overlaps_of(const World& world) {
  std::vector<Overlap> found;
  for (size_t i = 0; i < world.pairs().size(); ++i) {
    if (world.overlaps()[i] != 1) continue;
    const BodyId a = world.id_of(world.pairs()[i].a), b = world.id_of(world.pairs()[i].b);
    found.push_back({a.index, b.index, a.generation, b.generation});
  }
  return found;
}

std::vector<Overlap> events_of(const World& world, EventKind kind) {
  std::vector<Overlap> found;
  for (const Event& e : world.events()) {
    if (e.kind != kind) continue;
    found.push_back({e.a.index, e.b.index, e.a.generation, e.b.generation});
  }
  return found;
}

// Both lists have every pair of indices once, in their order.
std::vector<Overlap> difference(const std::vector<Overlap>& list,
                                const std::vector<Overlap>& other) {
  std::vector<Overlap> left;
  std::ranges::set_difference(list, other, std::back_inserter(left));
  return left;
}

// More blocks of pairs than are merged side by side; before and after bodies are removed.
TEST(EventSettings, OfManyPairsOnAnyThreads) {
  for (const bool threads : {false, true}) {
    World world({.parallelism = threads ? Parallelism::arena : Parallelism::none});
    std::vector<BodyId> ids = add_crowd(world, {.count = 20000, .side = 16.5, .boxes = false});
    Random random(5);
    std::vector<Overlap> last;
    for (int step = 0; step < 4; ++step) {
      if (step > 0) move_some(world, ids, 0.6, random);
      for (size_t i = 0; step == 2 && i < 300; ++i) {
        const size_t k = random.below(ids.size());
        const Eigen::Vector3d place = world.position(ids[k]);
        world.remove(ids[k]);
        ids[k] = world.add({.shape = Sphere{0.4f}, .position = place});
      }
      world.step();
      ASSERT_GT(world.pairs().size(), 16 * 4096u);
      const std::vector<Overlap> now = overlaps_of(world);
      EXPECT_EQ(events_of(world, EventKind::begin), difference(now, last)) << step;
      EXPECT_EQ(events_of(world, EventKind::end), difference(last, now)) << step;
      EXPECT_GT(world.events().size(), 1000u);
      EXPECT_TRUE(std::ranges::is_sorted(world.events(), {}, [](const Event& e) {
        return std::tuple(e.a.index, e.b.index, e.kind != EventKind::end);
      }));
      last = now;
    }
  }
}

TEST(EventSettings, AtRestThereAreNoneOrAllPersist) {
  for (const bool wants_persist : {false, true}) {
    World world({.persist_events = wants_persist});
    for (int i = 0; i < 2; ++i) world.add({.shape = Sphere{1}});
    world.step();
    ASSERT_EQ(world.events().size(), 1u);
    for (int i = 0; i < 3; ++i) {
      world.step();
      ASSERT_EQ(world.events().size(), wants_persist ? 1u : 0u);
      if (!wants_persist) continue;
      EXPECT_EQ(world.events()[0].kind, EventKind::persist);
    }
  }
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
