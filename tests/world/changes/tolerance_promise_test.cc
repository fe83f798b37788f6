// Accuracy::tolerance in worlds: how wrong results may be, in random histories.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <set>
#include <tuple>

#include "carom/base/thread_arena.h"
#include "tests/support/isas.h"
#include "tests/support/rounds.h"
#include "tests/world/side_by_side.h"
#include "tests/world/tolerance.h"

namespace carom::test {
namespace {

WorldSettings settings_for(uint64_t seed) {
  WorldSettings settings = varied_settings(seed);
  if (seed % 7 == 0) settings.margin = 0.1f;
  if (seed % 7 == 1) settings.dop_bounds = DopKind::k14;
  if (seed % 7 == 2) settings.contact_distance = 0.15f;
  if (seed % 7 == 3) settings.identities = true;
  if (seed % 7 == 4) settings.persist_events = true;
  if (seed % 7 == 5) settings.detail = Detail::regions;
  return settings;
}

float tolerance_of(const World& world, Pair pair) {
  const auto of = [&](uint32_t body) {
    return world.tolerance(world.id_of(body)).value_or(world.settings().accuracy.tolerance);
  };
  return (of(pair.a) + of(pair.b)) / 2;
}

constexpr double kRounding = 2e-5;

// Checks every decision and separation against the present poses, and that no overlap of `standard`
// is missing.
void check_error(const World& world, const World& standard) {
  // Fat bounds, and so the pairs, depend on the steps in which they were made.
  if (world.settings().margin == 0) {
    ASSERT_TRUE(std::ranges::includes(world.pairs(), standard.pairs()));
  }
  for (size_t i = 0; i < world.pairs().size(); ++i) {
    const Pair pair = world.pairs()[i];
    const double separation = true_separation(world, pair);
    if (std::abs(separation) <= tolerance_of(world, pair) + kRounding) continue;
    ASSERT_EQ(world.overlaps()[i], separation < 0) << separation;
  }
  std::set<std::pair<uint32_t, uint32_t>> listed;
  for (const Contact& contact : world.contacts()) {
    const Pair pair = {contact.a, contact.b};
    if (!listed.insert({pair.a, pair.b}).second) continue;  // the first one is the deepest
    const double separation = true_separation(world, pair);
    ASSERT_NEAR(contact.separation, separation, tolerance_of(world, pair) + kRounding);
  }
  for (const Contact& contact : standard.contacts()) {
    const Pair pair = {contact.a, contact.b};
    const double limit = standard.settings().contact_distance - tolerance_of(world, pair);
    if (true_separation(world, pair) >= limit - kRounding) continue;
    ASSERT_TRUE(listed.contains({pair.a, pair.b}));
  }
}

using Key = std::tuple<uint32_t, uint32_t, uint32_t, uint32_t>;

Key key_of(BodyId a, BodyId b) { return {a.index, a.generation, b.index, b.generation}; }

// Keeps a set of overlaps by events alone, and compares it with those of each step.
class OverlapsByEvents {
 public:
  void check(const World& world) {
    ASSERT_TRUE(std::ranges::is_sorted(world.events(), {}, [](const Event& event) {
      return std::pair(event.a.index, event.b.index);
    }));
    for (const Event& event : world.events()) {
      const Key key = key_of(event.a, event.b);
      if (event.kind == EventKind::begin) {
        ASSERT_TRUE(overlaps_.insert(key).second);
      } else if (event.kind == EventKind::end) {
        ASSERT_EQ(overlaps_.erase(key), 1u);
      }
      if (event.contact != kNoContact) {
        const Contact& contact = world.contacts()[event.contact];
        ASSERT_EQ(std::pair(contact.a, contact.b), std::pair(event.a.index, event.b.index));
      }
    }
    std::set<Key> expected;
    for (size_t i = 0; i < world.pairs().size(); ++i) {
      const Pair pair = world.pairs()[i];
      if (world.overlaps()[i] == 1)
        expected.insert(key_of(world.id_of(pair.a), world.id_of(pair.b)));
    }
    ASSERT_EQ(overlaps_, expected);
    ASSERT_EQ(world.report().overlaps, expected.size());
  }

 private:
  std::set<Key> overlaps_;
};

// Contacts are sorted, and those of overlaps and sensors.
void check_lists(const World& world) {
  ASSERT_TRUE(std::ranges::is_sorted(world.contacts(), {}, [](const Contact& contact) {
    return std::pair(contact.a, contact.b);
  }));
  if (has_manifolds(world.settings().detail)) {
    ASSERT_EQ(world.manifolds().size(), world.contacts().size());
  }
  if (!has_contacts(world.settings().detail) || world.settings().contact_distance > 0) return;
  std::set<std::pair<uint32_t, uint32_t>> touching, listed;
  for (size_t i = 0; i < world.pairs().size(); ++i) {
    const Pair pair = world.pairs()[i];
    const bool sensor =
        world.is_sensor(world.id_of(pair.a)) || world.is_sensor(world.id_of(pair.b));
    if (world.overlaps()[i] == 1 && !sensor) touching.insert({pair.a, pair.b});
  }
  for (const Contact& contact : world.contacts()) listed.insert({contact.a, contact.b});
  ASSERT_EQ(listed, touching);
}

TEST(Tolerance, SeparationsAreOffByItAtMost) {
  size_t kept = 0, tested = 0;
  for (uint64_t seed = 0; seed < rounds(60); ++seed) {
    const WorldSettings standard = settings_for(seed);
    const float metres = seed % 3 == 0 ? 0.4f : 0.06f;
    SideBySide worlds(std::vector{standard, within(metres, standard)}, varied_crowd(seed));
    if (seed % 4 == 0) worlds.set_tolerances(metres);
    OverlapsByEvents events;
    for (int i = 0; i < 20; ++i) {
      worlds.step();
      ASSERT_EQ(as_bytes(worlds[1].quarantined()), as_bytes(worlds[0].quarantined()));
      check_error(worlds[1], worlds[0]);
      check_lists(worlds[1]);
      events.check(worlds[1]);
      ASSERT_FALSE(HasFailure()) << "seed " << seed << ", step " << i;
      if (i > 0) kept += worlds[1].report().kept;
      tested += worlds[1].report().tested;
      worlds.creep(metres / 8);
      if (i % 5 == 4) worlds.disturb();
    }
  }
  EXPECT_GT(kept, tested);
}

// Points of kept contacts are named and continued like any others.
TEST(Tolerance, ContactsContinueThoseOfTheSamePair) {
  size_t continued = 0, renewed = 0;
  for (uint64_t seed = 0; seed < rounds(20); ++seed) {
    WorldSettings settings =
        within(0.06f, {.detail = seed % 2 ? Detail::manifold : Detail::contact});
    settings.identities = true;
    SideBySide worlds(std::vector{settings}, varied_crowd(seed));
    World& world = worlds[0];
    std::vector<Contact> last;
    for (int i = 0; i < 12; ++i) {
      worlds.step();
      ASSERT_EQ(world.identities().size(), world.contacts().size());
      std::set<uint32_t> used;
      for (size_t k = 0; k < world.contacts().size(); ++k) {
        const uint32_t previous = world.identities()[k].previous;
        if (previous == kNoPrevious) continue;
        ASSERT_LT(previous, last.size());
        ASSERT_TRUE(used.insert(previous).second);
        const Contact &before = last[previous], &now = world.contacts()[k];
        ASSERT_EQ(std::pair(before.a, before.b), std::pair(now.a, now.b));
        ++continued;
        renewed += before.separation != now.separation;
      }
      last.assign(world.contacts().begin(), world.contacts().end());
      worlds.creep(0.01);
      if (i % 5 == 4) worlds.disturb();
    }
  }
  EXPECT_GT(continued, 50 * rounds(20));
  EXPECT_GT(renewed, 5 * rounds(20));
}

// Includes a tolerance that no motion stays within.
TEST(Tolerance, OfZeroChangesNoBit) {
  for (uint64_t seed = 0; seed < rounds(20); ++seed) {
    const WorldSettings standard = settings_for(seed);
    WorldSettings anew = within(1, standard);
    anew.carry_results = false;
    WorldSettings proven = within(1, standard);
    proven.accuracy.tier = Tier::certified;
    WorldSettings certified = standard;
    certified.accuracy.tier = Tier::certified;
    SideBySide worlds(std::vector{standard, within(0, standard), anew, certified, proven},
                      varied_crowd(seed));
    for (int i = 0; i < 10; ++i) {
      worlds.step();
      for (const size_t other : {1, 2}) {
        ASSERT_TRUE(results(worlds[other]) == results(worlds[0])) << other << ", step " << i;
      }
      ASSERT_TRUE(results(worlds[4]) == results(worlds[3])) << "step " << i;
      ASSERT_EQ(worlds[1].bytes(), worlds[0].bytes());
      worlds.creep(0.05);
      if (i % 3 == 1) worlds.disturb();
    }
  }
}

TEST(Tolerance, TheSameOnThreads) {
  ThreadArena arena(2);
  WorldSettings threaded = within(0.1f, {.detail = Detail::manifold});
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
      if (i % 2) worlds.disturb();
    }
    EXPECT_GT(worlds[1].report().kept, worlds[1].report().pairs / 10);
  });
}

TEST(Tolerance, TheSameOnEveryIsa) {
  std::vector<Results> expected;
  for_each_isa([&] {
    SideBySide worlds(std::vector{within(0.1f, {.detail = Detail::manifold})},
                      varied_crowd(1, 800));
    for (size_t i = 0; i < 6; ++i) {
      worlds.step();
      if (expected.size() == i) expected.push_back(results(worlds[0]));
      ASSERT_TRUE(results(worlds[0]) == expected[i]) << i;
      worlds.creep(0.02);
    }
  });
}

// Where everything flies, no result is held, but in a few steps that look whether it still does;
// and what needs no search for a depth has the results of the standard tier.
TEST(Tolerance, IsLeftAloneWhereNothingHolds) {
  const WorldSettings standard = {};
  SideBySide worlds(std::vector{standard, within(1e-4f)}, varied_crowd(4, 500));
  int plain = 0;
  const auto has_early_depth = [](const Contact& contact, const World& world) {
    const auto has_search = [&](uint32_t body) {
      const ShapeKind kind = kind_of(world.shape(world.id_of(body)));
      return is_composite(kind) || kind == ShapeKind::hull || kind == ShapeKind::dop;
    };
    return has_search(contact.a) || has_search(contact.b);
  };
  for (int i = 0; i < 40; ++i) {
    worlds.step();
    std::array<std::vector<Contact>, 2> contacts;
    for (size_t k : {0, 1}) {
      for (const Contact& contact : worlds[k].contacts()) {
        if (!has_early_depth(contact, worlds[k])) contacts[k].push_back(contact);
      }
    }
    const bool is_same = std::ranges::equal(contacts[0], contacts[1], [](auto& x, auto& y) {
      return std::memcmp(&x, &y, sizeof x) == 0;
    });
    plain += is_same && worlds[1].report().kept == worlds[0].report().kept;
    worlds.creep(0.5);
  }
  EXPECT_GT(plain, 30);
  for (int i = 0; i < 3; ++i) worlds.step();  // nothing moves
  EXPECT_EQ(worlds[1].report().tested, 0u);
}

}  // namespace
}  // namespace carom::test
