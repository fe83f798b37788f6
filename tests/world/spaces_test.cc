// Many spaces in one world: each has the results of a world of its own.
#include <gtest/gtest.h>

#include "carom/base/thread_arena.h"
#include "tests/world/crowds.h"

namespace carom::test {
namespace {

constexpr uint32_t kSpaces = 40;

CrowdSpec crowd_of(uint32_t space) {
  return {.count = 20 + space % 3,
          .side = 2,
          .oriented = true,
          .halfspaces = 1 + space % 2,
          .velocities = true,
          .seed = space + 1};
}

// The same bodies in one world, and in a world for each space.
class ManyWorlds {
 public:
  explicit ManyWorlds(const WorldSettings& settings) : together_(settings) {
    for (uint32_t space = 0; space < kSpaces; ++space) {
      alone_.emplace_back(settings);
      ids_alone_.push_back(add_crowd(alone_.back(), crowd_of(space)));
      std::vector<BodyDesc> bodies = make_crowd(crowd_of(space));
      for (BodyDesc& body : bodies) body.space = space;
      first_.push_back(static_cast<uint32_t>(together_.size()));
      ids_.emplace_back();
      together_.add(bodies, ids_.back());
    }
  }

  World& together() { return together_; }
  BodyId id(uint32_t space, size_t i) const { return ids_[space][i]; }

  void step(double share) {
    for (uint32_t space = 0; space < kSpaces; ++space) {
      Random random(++seed_), same(seed_);
      move_some(together_, ids_[space], share, random);
      move_some(alone_[space], ids_alone_[space], share, same);
      alone_[space].step();
    }
    together_.step();
  }

  // Whether the contacts of the space, and their points, are the bits of the world of its own.
  ::testing::AssertionResult agrees(uint32_t space) const {
    SpaceGroups groups;
    together_.group_contacts(groups);
    std::vector<Contact> contacts;
    std::vector<ManifoldPoints> manifolds;
    for (size_t k = 0; k < groups.spaces.size(); ++k) {
      if (groups.spaces[k] != space) continue;
      for (uint32_t i = groups.first[k]; i < groups.first[k + 1]; ++i) {
        contacts.push_back(together_.contacts()[groups.items[i]]);
        contacts.back().a -= first_[space];
        contacts.back().b -= first_[space];
        manifolds.push_back(together_.manifolds()[groups.items[i]]);
      }
    }
    const World& alone = alone_[space];
    if (as_bytes(std::span<const Contact>(contacts)) == as_bytes(alone.contacts()) &&
        as_bytes(std::span<const ManifoldPoints>(manifolds)) == as_bytes(alone.manifolds())) {
      return ::testing::AssertionSuccess() << contacts.size();
    }
    return ::testing::AssertionFailure() << "space " << space << ": " << contacts.size()
                                         << " contacts, alone " << alone.contacts().size();
  }

 private:
  World together_;
  std::vector<World> alone_;
  std::vector<std::vector<BodyId>> ids_, ids_alone_;
  std::vector<uint32_t> first_;
  uint64_t seed_ = 0;
};

TEST(Spaces, HaveTheResultsOfWorldsOfTheirOwn) {
  for (const PositionType positions : {PositionType::float32, PositionType::float64}) {
    ManyWorlds worlds({.positions = positions, .detail = Detail::manifold});
    for (int step = 0; step < 6; ++step) {
      worlds.step(0.4);
      for (uint32_t space = 0; space < kSpaces; ++space) ASSERT_TRUE(worlds.agrees(space));
    }
    EXPECT_GT(worlds.together().contacts().size(), 10 * kSpaces);
    EXPECT_EQ(worlds.together().report().search.method, BroadphaseMethod::brute);
    EXPECT_GT(worlds.together().report().kept, 5 * kSpaces);
  }
}

TEST(Spaces, HaveTheSameResultsOnThreads) {
  ThreadArena arena(4);
  arena.run([&] {
    ManyWorlds worlds({.detail = Detail::manifold, .parallelism = arena.parallelism()});
    for (int step = 0; step < 3; ++step) worlds.step(0.4);
    for (uint32_t space = 0; space < kSpaces; ++space) EXPECT_TRUE(worlds.agrees(space));
  });
}

// Bodies of one space that are reset, or hold NaN, cost no other space its kept results.
TEST(Spaces, TouchNoOthersResults) {
  ManyWorlds worlds({.detail = Detail::manifold});
  worlds.step(0);
  worlds.step(0);
  World& world = worlds.together();
  SpaceGroups groups;
  world.group_pairs(groups);
  ASSERT_EQ(groups.spaces.size(), kSpaces);
  const size_t of_first = groups.first[4] - groups.first[3];
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  world.set_position(worlds.id(3, 5), {kNan, 0, 0});
  world.set_position(worlds.id(3, 6), {0.5, 0.5, 0.5});
  const size_t before = world.report().pairs;
  world.step();
  EXPECT_EQ(world.quarantined().size(), 1u);
  EXPECT_GT(world.report().tested, 0u);
  EXPECT_LE(world.report().tested, 20u);
  EXPECT_GE(world.report().kept, before - of_first);
  for (uint32_t space = 0; space < kSpaces; ++space) {
    if (space == 3) continue;
    EXPECT_TRUE(worlds.agrees(space));
  }
}

TEST(Spaces, GroupResultsInAnyOrderOfBodies) {
  World world;
  SpaceGroups groups;
  world.step();
  world.group_contacts(groups);
  EXPECT_EQ(groups.spaces.size(), 0u);
  EXPECT_EQ(groups.first, std::vector<uint32_t>{0});
  // Three balls in one place in each of these spaces, not one after the other.
  for (int ball = 0; ball < 3; ++ball) {
    for (const uint32_t space : {9u, 0u, 4'000'000'000u}) {
      world.add({.shape = Sphere{1}, .space = space});
    }
  }
  world.step();
  for (const bool contacts : {false, true}) {
    contacts ? world.group_contacts(groups) : world.group_pairs(groups);
    EXPECT_EQ(groups.spaces, (std::vector<uint32_t>{0, 9, 4'000'000'000u}));
    EXPECT_EQ(groups.first, (std::vector<uint32_t>{0, 3, 6, 9}));
    for (size_t i = 0; i < 9; ++i) {
      const Pair pair = world.pairs()[groups.items[i]];
      constexpr uint32_t kPlaces[] = {1, 0, 2};  // of spaces 0, 9, 4,000,000,000 among the three
      EXPECT_EQ(pair.a % 3, kPlaces[i / 3]);
      EXPECT_EQ(pair.a % 3, pair.b % 3);
    }
  }
}

}  // namespace
}  // namespace carom::test
