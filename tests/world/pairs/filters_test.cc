// Excluded pairs, groups, spaces, rules and predicates of a world that change while bodies rest.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>

#include "carom/base/thread_arena.h"
#include "tests/world/crowds.h"

namespace carom::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

BodyDesc ball_at(double x) { return {.shape = Sphere{0.6f}, .position = {x, 0, 0}}; }

std::vector<Pair> pairs_of(const World& world) {
  return {world.pairs().begin(), world.pairs().end()};
}

// A row of balls, each touching the next, at rest for long enough that the broadphase and the world
// keep what they found.
class RestingRow {
 public:
  explicit RestingRow(WorldSettings settings = {}, size_t count = 400) : world(settings) {
    for (size_t i = 0; i < count; ++i) ids.push_back(world.add(ball_at(static_cast<double>(i))));
    for (int i = 0; i < 6; ++i) world.step();
  }

  size_t all() const { return ids.size() - 1; }

  // Steps; expects all pairs but these, and one event of this kind for each of `changed`.
  void expect_without(const std::vector<Pair>& gone, EventKind kind,
                      const std::vector<Pair>& changed) {
    world.step();
    std::vector<Pair> expected;
    for (uint32_t i = 0; i + 1 < ids.size(); ++i) {
      const Pair pair = {i, i + 1};
      if (std::find(gone.begin(), gone.end(), pair) == gone.end()) expected.push_back(pair);
    }
    EXPECT_TRUE(pairs_of(world) == expected);
    EXPECT_EQ(world.report().search.pairs, expected.size());
    if (world.settings().detail == Detail::pairs) return;
    EXPECT_EQ(world.contacts().size(), expected.size());
    ASSERT_EQ(world.events().size(), changed.size());
    for (size_t i = 0; i < changed.size(); ++i) {
      EXPECT_EQ(world.events()[i].kind, kind);
      EXPECT_EQ(world.events()[i].gone, 0);
      EXPECT_EQ((Pair{world.events()[i].a.index, world.events()[i].b.index}), changed[i]);
    }
  }

  World world;
  std::vector<BodyId> ids;
};

const std::vector<WorldSettings> kWorlds = {
    {},
    {.broadphase = BroadphaseMethod::sweep},
    {.broadphase = BroadphaseMethod::brute},
    {.broadphase = BroadphaseMethod::grid},
    {.broadphase = BroadphaseMethod::grid, .carry_results = false},
    {.detail = Detail::pairs},
    {.detail = Detail::manifold, .margin = 0.1f},
};

TEST(ExcludedWorld, PairsOfRestingBodiesComeAndGo) {
  for (const WorldSettings& settings : kWorlds) {
    RestingRow row(settings);
    row.world.exclude(row.ids[7], row.ids[6]);
    EXPECT_TRUE(row.world.is_excluded(row.ids[6], row.ids[7]));
    row.expect_without({{6, 7}}, EventKind::end, {{6, 7}});
    if (settings.carry_results) {
      EXPECT_EQ(row.world.report().tested, 0u) << "nothing moved";
    }
    for (int i = 0; i < 3; ++i) row.expect_without({{6, 7}}, EventKind::end, {});
    EXPECT_TRUE(row.world.is_excluded(row.ids[6], row.ids[7]));
    row.world.exclude(std::vector<Pair>{{0, 1}, {6, 7}, {399, 398}, {10, 200}});
    row.expect_without({{0, 1}, {6, 7}, {398, 399}}, EventKind::end, {{0, 1}, {398, 399}});
    row.world.include_again(row.ids[6], row.ids[7]);
    EXPECT_FALSE(row.world.is_excluded(row.ids[6], row.ids[7]));
    row.expect_without({{0, 1}, {398, 399}}, EventKind::begin, {{6, 7}});
    if (settings.carry_results && settings.detail != Detail::pairs) {
      EXPECT_EQ(row.world.report().tested, 1u) << "the pair that is there again";
    }
    row.world.include_again(std::vector<Pair>{{1, 0}, {398, 399}, {3, 4}});
    row.expect_without({}, EventKind::begin, {{0, 1}, {398, 399}});
  }
}

TEST(ExcludedWorld, PairChangesFollow) {
  RestingRow row({.pair_changes = true});
  row.world.exclude(row.ids[3], row.ids[4]);
  row.world.step();
  EXPECT_THAT(row.world.removed_pairs(), ElementsAre(Pair{3, 4}));
  EXPECT_THAT(row.world.added_pairs(), IsEmpty());
  row.world.include_again(row.ids[3], row.ids[4]);
  row.world.step();
  EXPECT_THAT(row.world.added_pairs(), ElementsAre(Pair{3, 4}));
}

TEST(ExcludedWorld, AnIndexInheritsNothing) {
  for (const WorldSettings& settings : kWorlds) {
    RestingRow row(settings);
    row.world.exclude(row.ids[6], row.ids[7]);
    row.world.exclude(row.ids[20], row.ids[21]);
    row.world.step();
    row.world.remove(row.ids[7]);
    row.ids[7] = row.world.add(ball_at(7));
    ASSERT_EQ(row.ids[7].index, 7u);
    EXPECT_FALSE(row.world.is_excluded(row.ids[6], row.ids[7]));
    row.world.step();
    EXPECT_EQ(row.world.report().pairs, row.all() - 1);
    // Removed and excluded again in any order between two steps.
    row.world.exclude(row.ids[6], row.ids[7]);
    row.world.remove(row.ids[7]);
    row.ids[7] = row.world.add(ball_at(7));
    EXPECT_FALSE(row.world.is_excluded(row.ids[6], row.ids[7]));
    row.world.exclude(row.ids[7], row.ids[8]);
    EXPECT_TRUE(row.world.is_excluded(row.ids[7], row.ids[8]));
    row.world.step();
    std::vector<Pair> expected;
    for (uint32_t i = 0; i < 399; ++i) {
      if (i != 7 && i != 20) expected.push_back({i, i + 1});
    }
    EXPECT_TRUE(pairs_of(row.world) == expected);
    row.world.remove(row.ids[8]);
    row.world.remove(row.ids[21]);
    row.world.step();
    row.ids[8] = row.world.add(ball_at(8));
    row.ids[21] = row.world.add(ball_at(21));
    row.world.step();
    EXPECT_EQ(row.world.report().pairs, row.all());
  }
}

TEST(ExcludedWorld, PairsWithHalfspacesToo) {
  World world;
  const BodyId ground = world.add({.shape = Halfspace{{1, 0, 0}, 2}});
  const BodyId a = world.add(ball_at(0)), b = world.add(ball_at(1));
  world.step();
  EXPECT_TRUE(pairs_of(world) == (std::vector<Pair>{{0, 1}, {0, 2}, {1, 2}}));
  world.exclude(b, ground);
  world.step();
  EXPECT_TRUE(pairs_of(world) == (std::vector<Pair>{{0, 1}, {1, 2}}));
  world.exclude(a, ground);
  world.set_pair_predicate([](std::span<const Pair> pairs, std::span<uint8_t> keep) {
    EXPECT_EQ(pairs.size(), 1u);
    keep[0] = 0;
  });
  EXPECT_EQ(world.step().pairs, 0u);
}

// Impacts and speculative contacts come from the same pairs.
TEST(ExcludedWorld, PairsDoNotMeetInTheIntervalAhead) {
  for (const Detection detection : {Detection::swept, Detection::continuous}) {
    World world({.dt = 1});
    const BodyId wall = world.add({.shape = Box{{0.1f, 5, 5}}, .motion = Motion::fixed});
    const BodyId bullet = world.add({.shape = Sphere{0.1f},
                                     .position = {-3, 0, 0},
                                     .linear_velocity = {10, 0, 0},
                                     .detection = detection});
    const auto found = [&] {
      world.step();
      return world.impacts().size() + world.speculative_contacts().size();
    };
    EXPECT_EQ(found(), 1u);
    world.exclude(wall, bullet);
    EXPECT_EQ(found(), 0u);
    EXPECT_TRUE(world.pairs().empty());
    world.include_again(wall, bullet);
    EXPECT_EQ(found(), 1u);
  }
}

TEST(ExcludedWorld, AMillionThatDoNotMeetAreNoPairs) {
  World plain, world;
  const CrowdSpec spec{.count = 3000, .side = 30, .oriented = true, .filters = true};
  for (World* w : {&plain, &world}) {
    add_crowd(*w, spec);
    w->step();
  }
  const std::vector<Pair> pairs = pairs_of(plain);
  ASSERT_GT(pairs.size(), 100u);
  std::vector<Pair> excluded;
  for (uint32_t a = 0; a < 3000; ++a) {
    for (uint32_t b = a + 1; b < std::min(3000u, a + 360); ++b) {
      if (!std::binary_search(pairs.begin(), pairs.end(), Pair{a, b})) excluded.push_back({b, a});
    }
  }
  ASSERT_GT(excluded.size(), 900'000u);
  world.exclude(excluded);
  for (World* w : {&plain, &world}) {
    for (int i = 0; i < 3; ++i) {
      w->set_position(w->id_of(2999), {-99.0 - i, 0, 0});
      w->step();
    }
  }
  EXPECT_TRUE(results(plain) == results(world));
}

TEST(FilterWorld, GroupsAndSpacesOfRestingBodiesMayChange) {
  for (const WorldSettings& settings : kWorlds) {
    RestingRow row(settings);
    row.world.set_group(row.ids[6], -3);
    row.world.set_group(row.ids[7], -3);
    row.world.set_space(row.ids[100], 1);
    row.expect_without({{6, 7}, {99, 100}, {100, 101}}, EventKind::end,
                       {{6, 7}, {99, 100}, {100, 101}});
    for (int i = 0; i < 3; ++i) {
      row.expect_without({{6, 7}, {99, 100}, {100, 101}}, EventKind::end, {});
    }
    row.world.set_group(row.ids[6], -4);
    row.world.set_space(row.ids[101], 1);
    row.world.set_space(row.ids[102], 1);
    row.world.step();
    EXPECT_EQ(row.world.report().pairs, row.all() - 2);
    for (const uint32_t i : {100u, 101u, 102u}) row.world.set_space(row.ids[i], 0);
    row.world.step();
    EXPECT_EQ(row.world.report().pairs, row.all());
    row.world.set_filter(row.ids[50], 1, 0, 0);
    row.expect_without({{49, 50}, {50, 51}}, EventKind::end, {{49, 50}, {50, 51}});
    row.world.set_group(row.ids[50], 2);
    row.world.set_group(row.ids[51], 2);
    row.expect_without({{49, 50}}, EventKind::begin, {{50, 51}});
    row.world.remove(row.ids[51]);
    row.ids[51] = row.world.add(ball_at(51));
    row.world.step();
    EXPECT_EQ(row.world.report().pairs, row.all() - 2) << "the new body is in no group";
  }
}

TEST(FilterWorld, TheRuleIsASetting) {
  for (const FilterRule rule : {FilterRule::both, FilterRule::either}) {
    World world({.filter_rule = rule});
    BodyDesc a = ball_at(0), b = ball_at(1);
    a.layer = b.mask = 1;
    a.mask = 2;
    b.layer = 4;
    world.add(a);
    world.add(b);
    EXPECT_EQ(world.step().pairs, rule == FilterRule::either ? 1u : 0u);
  }
}

TEST(PredicateWorld, DecidesLastAndMayBeReplacedAtRest) {
  for (const WorldSettings& settings : kWorlds) {
    RestingRow row(settings);
    std::atomic<size_t> asked{0};
    row.world.exclude(row.ids[0], row.ids[1]);
    row.world.set_pair_predicate([&](std::span<const Pair> pairs, std::span<uint8_t> keep) {
      asked += pairs.size();
      for (size_t i = 0; i < pairs.size(); ++i) keep[i] = pairs[i].a != 9;
    });
    row.expect_without({{0, 1}, {9, 10}}, EventKind::end, {{0, 1}, {9, 10}});
    EXPECT_EQ(asked, row.all() - 1);
    row.world.set_pair_predicate([](std::span<const Pair> pairs, std::span<uint8_t> keep) {
      for (size_t i = 0; i < pairs.size(); ++i) keep[i] = pairs[i].a != 0;
    });
    row.expect_without({{0, 1}}, EventKind::begin, {{9, 10}});
    row.world.set_pair_predicate({});
    row.expect_without({{0, 1}}, EventKind::begin, {});
  }
}

// The predicate reads the caller's numbers of the bodies while the world steps on threads.
TEST(PredicateWorld, IsTheSameOnThreads) {
  const auto run = [](int threads) {
    ThreadArena arena(threads);
    World world({.broadphase = BroadphaseMethod::grid});
    const std::vector<BodyId> ids = add_crowd(world, {.count = 6000, .side = 14, .oriented = true});
    for (size_t i = 0; i < ids.size(); ++i) world.set_user(ids[i], i * 7919 % 5);
    world.set_pair_predicate([&](std::span<const Pair> pairs, std::span<uint8_t> keep) {
      for (size_t i = 0; i < pairs.size(); ++i) {
        const uint64_t a = world.user(world.id_of(pairs[i].a));
        const uint64_t b = world.user(world.id_of(pairs[i].b));
        keep[i] = (a + b) % 5 < 2;
      }
    });
    std::vector<Results> all;
    Random random(1);
    arena.run([&] {
      for (int step = 0; step < 6; ++step) {
        world.exclude(
            std::vector<Pair>(world.pairs().begin(), world.pairs().begin() + (step > 0 ? 50 : 0)));
        move_some(world, ids, step < 3 ? 0.01 : 0.5, random);
        world.step();
        all.push_back(results(world));
      }
    });
    EXPECT_GT(world.pairs().size(), 4096u) << "more than a batch";
    return all;
  };
  const std::vector<Results> one = run(1);
  EXPECT_TRUE(run(2) == one);
  EXPECT_TRUE(run(4) == one);
}

}  // namespace
}  // namespace carom::test
