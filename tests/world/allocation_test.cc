// A step like the last one allocates nothing.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "tests/support/composites.h"
#include "tests/world/counted_malloc.h"
#include "tests/world/crowds.h"

#if defined(CAROM_TEST_COUNTS_MALLOC)

namespace carom::test {
namespace {

// Prepares a new world before its first step. It may add bodies; the first ones move.
using Prepare = std::function<void(World&, std::vector<BodyId>&)>;

// Bodies that move in circles: every fourth step is the same.
class Carousel {
 public:
  Carousel(const WorldSettings& settings, const CrowdSpec& spec, const Prepare& prepare)
      : world_(settings), ids_(add_crowd(world_, spec)) {
    if (prepare) prepare(world_, ids_);
    for (const BodyId id : ids_) homes_.push_back(world_.position(id));
  }

  World& world() { return world_; }

  void turn(size_t movers) {
    constexpr double kWays[4][2] = {{0, 0}, {0.3, 0}, {0.3, 0.3}, {0, 0.3}};
    const auto& way = kWays[turn_++ % 4];
    for (size_t i = 0; i < movers; ++i) {
      world_.set_position(ids_[i], homes_[i] + Eigen::Vector3d(way[0], way[1], 0));
      world_.set_orientation(ids_[i], {1, static_cast<float>(way[0]), 0, 0.5f});
    }
    world_.step();
  }

 private:
  World world_;
  std::vector<BodyId> ids_;
  std::vector<Eigen::Vector3d> homes_;
  size_t turn_ = 0;
};

// `rest`: in every second round nothing moves. `rounds`: enough for every kind of step to occur.
void expect_no_allocations(const WorldSettings& settings, const CrowdSpec& spec, size_t movers,
                           bool rest = false, int rounds = 4, const Prepare& prepare = {}) {
  Carousel carousel(settings, spec, prepare);
  const auto round = [&] {
    for (int i = 0; i < 4; ++i) carousel.turn(movers);
    if (rest) carousel.world().step();
  };
  for (int i = 0; i < rounds; ++i) round();
  const size_t bytes = carousel.world().bytes();
  const size_t before = allocations();
  for (int i = 0; i < 10; ++i) round();
  EXPECT_EQ(allocations() - before, 0u) << spec.count << " bodies, " << movers << " of them moving";
  EXPECT_EQ(carousel.world().bytes(), bytes);
  EXPECT_GT(carousel.world().report().pairs, 0u);
}

// Keeps the compiler from removing an unused allocation.
void use(const void* memory) {
  static const void* volatile seen;
  seen = memory;
  (void)seen;
}

TEST(Allocations, AreCounted) {
  const size_t before = allocations();
  const auto many = std::make_unique<std::array<double, 99>>();
  use(many.get());
  std::vector<Pair> more(many->size());
  use(more.data());
  EXPECT_GE(allocations() - before, 2u);
  const size_t aligned = allocations();
  struct alignas(64) Line {
    char bytes[64];
  };
  const auto line = std::make_unique<Line>();
  use(line.get());
  EXPECT_EQ(allocations() - aligned, 1u);
}

TEST(Allocations, NoneInAStillWorld) {
  expect_no_allocations({}, {.filters = true, .velocities = true}, 0);
}

TEST(Allocations, NoneWithMovingBodies) {
  for (const size_t movers : {1, 40, 400}) {
    expect_no_allocations({}, {}, movers);
    expect_no_allocations({}, {.boxes = false}, movers, true);
    expect_no_allocations({}, {.filters = true, .velocities = true}, movers, true);
    expect_no_allocations({.positions = PositionType::float64}, {.filters = true}, movers);
  }
}

TEST(Allocations, NoneWithAllKinds) {
  for (const size_t halfspaces : {0, 3}) {
    const CrowdSpec spec{
        .oriented = true, .halfspaces = halfspaces, .filters = true, .velocities = true};
    for (const size_t movers : {0, 40, 400}) {
      for (const Detail detail : {Detail::pairs, Detail::contact, Detail::manifold}) {
        expect_no_allocations({.detail = detail}, spec, movers, true);
        expect_no_allocations({.detail = detail, .margin = 0.2f, .pair_changes = true}, spec,
                              movers);
      }
    }
  }
}

// Nor does a world give memory back by itself.
TEST(Allocations, NoneInAWorldThatGrowsAgain) {
  World world({.detail = Detail::manifold});
  const std::vector<BodyDesc> crowd = make_crowd({.oriented = true, .halfspaces = 2});
  std::vector<BodyId> ids;
  const auto grow_and_shrink = [&] {
    world.add(crowd, ids);
    world.step();
    world.remove(ids);
    world.step();
    ids.clear();
  };
  for (int i = 0; i < 3; ++i) grow_and_shrink();
  const size_t bytes = world.bytes(), before = allocations();
  for (int i = 0; i < 3; ++i) grow_and_shrink();
  EXPECT_EQ(allocations() - before, 0u);
  EXPECT_EQ(world.bytes(), bytes);
}

TEST(Allocations, NoneInAWorldOfManyBlocks) {
  expect_no_allocations({}, {.count = 9000, .side = 20}, 900, true);
  expect_no_allocations({}, {.count = 9000, .side = 20}, 9000);
}

TEST(Allocations, NoneWithOtherSettings) {
  const CrowdSpec spec{.filters = true, .velocities = true};
  expect_no_allocations({.detail = Detail::pairs}, spec, 100);
  expect_no_allocations({.detail = Detail::overlap}, spec, 100);
  expect_no_allocations({.broadphase = BroadphaseMethod::brute}, spec, 100);
  expect_no_allocations({.events = false}, spec, 100);
  for (const Detail detail : {Detail::pairs, Detail::contact}) {
    const WorldSettings all{.detail = detail, .margin = 0.2f, .pair_changes = true};
    for (const size_t movers : {0, 1, 400}) expect_no_allocations(all, spec, movers, true);
    expect_no_allocations({.detail = detail, .dop_bounds = DopKind::k18}, spec, 100);
    // With margins some boxes join the resting ones now and then.
    expect_no_allocations(all, {.count = 3000, .side = 14}, 100, true, 40);
  }
  expect_no_allocations({.carry_results = false}, spec, 400);
  expect_no_allocations({}, {.count = 60, .side = 3}, 60, true);
}

TEST(Allocations, NoneWhenLookingAhead) {
  const CrowdSpec spec{.halfspaces = 2, .filters = true, .velocities = true, .looks_ahead = true};
  for (const size_t movers : {0, 40, 400}) {
    for (const Impacts impacts : {Impacts::earliest, Impacts::all}) {
      expect_no_allocations({.impacts = impacts}, spec, movers, true);
    }
    expect_no_allocations({.detail = Detail::pairs}, spec, movers, true);
    expect_no_allocations({.detail = Detail::overlap}, spec, movers);
    expect_no_allocations({.margin = 0.2f, .pair_changes = true}, spec, movers, true);
  }
  const CrowdSpec oriented{.oriented = true, .velocities = true, .looks_ahead = true};
  for (const size_t movers : {0, 40}) expect_no_allocations({}, oriented, movers, true);
}

// --- Contacts: composites, regions, distances, identities ---

// Adds meshes and compounds, of which those that move come first.
void add_composites_first(World& world, std::vector<BodyId>& ids) {
  Composites composites(3);
  std::vector<BodyId> added;
  for (size_t i = 0; i < 60; ++i) {
    added.push_back(
        world.add({.shape = i % 2 ? Shape(composites.mesh(0.8)) : composites.compound(0.8),
                   .position = random_position(composites.random(), 7),
                   .orientation = composites.orientation()}));
  }
  ids.insert(ids.begin(), added.begin(), added.end());
}

// One thread alone, since allocations of others are not counted.
void expect_no_allocations_with_composites(WorldSettings settings) {
  settings.parallelism = Parallelism::none;
  const CrowdSpec spec{
      .count = 80, .side = 6, .oriented = true, .halfspaces = 1, .velocities = true};
  for (const size_t movers : {0, 1, 40, 140}) {
    expect_no_allocations(settings, spec, movers, true, 4, add_composites_first);
  }
}

TEST(Allocations, NoneWithComposites) {
  for (const Detail detail : {Detail::overlap, Detail::contact, Detail::manifold}) {
    expect_no_allocations_with_composites({.detail = detail});
  }
}

TEST(Allocations, NoneWithRegions) {
  for (const RegionLimits& limits : {RegionLimits{}, RegionLimits{.cosine = 0.999, .most = 2}}) {
    expect_no_allocations_with_composites({.detail = Detail::regions, .region_limits = limits});
    expect_no_allocations_with_composites(
        {.detail = Detail::regions, .region_limits = limits, .carry_results = false});
  }
}

// The number of blocks rises and falls with that of the tested pairs: 2,043 to 2,760 in turn.
TEST(Allocations, NoneWithRegionsOfSeveralBlocks) {
  const CrowdSpec spec{.oriented = true, .halfspaces = 2, .velocities = true};
  for (const float distance : {0.0f, 0.1f}) {
    expect_no_allocations(
        {.detail = Detail::regions, .parallelism = Parallelism::none, .contact_distance = distance},
        spec, 400, true, 4, add_composites_first);
  }
}

TEST(Allocations, NoneWithContactDistancesAndIdentities) {
  for (const Detail detail : {Detail::contact, Detail::manifold, Detail::regions}) {
    expect_no_allocations_with_composites({.detail = detail, .contact_distance = 0.1f});
    expect_no_allocations_with_composites({.detail = detail, .identities = true});
    expect_no_allocations_with_composites({.detail = detail,
                                           .contact_distance = 0.1f,
                                           .persist_events = true,
                                           .identities = true,
                                           .pair_changes = true});
  }
  // A distance of some bodies alone.
  expect_no_allocations({.detail = Detail::regions}, {.oriented = true}, 40, true, 4,
                        [](World& world, std::vector<BodyId>& ids) {
                          for (size_t i = 0; i < ids.size(); i += 3) {
                            world.set_contact_distance(ids[i], 0.2f);
                          }
                        });
}

TEST(Allocations, NoneWithPersistEvents) {
  const CrowdSpec spec{.filters = true, .velocities = true};
  for (const size_t movers : {0, 1, 40, 400}) {
    expect_no_allocations({.persist_events = true}, spec, movers, true);
    expect_no_allocations({.detail = Detail::overlap, .persist_events = true}, spec, movers, true);
  }
}

// --- Excluded pairs and a predicate ---

// Excludes pairs, of which many are candidates, and drops others with a predicate.
void exclude_and_drop(World& world, std::vector<BodyId>& ids) {
  for (size_t i = 0; i < ids.size(); ++i) {
    for (size_t k = 1; k < 9; ++k) world.exclude(ids[i], ids[(i + 37 * k) % ids.size()]);
  }
  world.set_pair_predicate([](std::span<const Pair> pairs, std::span<uint8_t> keep) {
    for (size_t i = 0; i < pairs.size(); ++i) keep[i] = (pairs[i].a + pairs[i].b) % 5 != 0;
  });
}

TEST(Allocations, NoneWithExcludedPairsAndAPredicate) {
  for (const size_t movers : {0, 1, 40, 400}) {
    for (const Detail detail : {Detail::pairs, Detail::contact}) {
      expect_no_allocations({.detail = detail, .persist_events = true}, {.oriented = true}, movers,
                            true, 4, exclude_and_drop);
    }
    expect_no_allocations({}, {.count = 9000, .side = 20}, movers, true, 4, exclude_and_drop);
  }
}

// The predicate is set in every step.
TEST(Allocations, NoneWhenThePredicateChanges) {
  World world;
  std::vector<BodyId> ids = add_crowd(world, {});
  exclude_and_drop(world, ids);
  const auto round = [&] {
    for (const uint32_t odd : {3u, 5u}) {
      world.set_pair_predicate([odd](std::span<const Pair> some, std::span<uint8_t> keep) {
        for (size_t i = 0; i < some.size(); ++i) keep[i] = (some[i].a * odd + some[i].b) % 7 != 0;
      });
      world.step();
    }
  };
  for (int i = 0; i < 4; ++i) round();
  const size_t before = allocations();
  for (int i = 0; i < 10; ++i) round();
  EXPECT_EQ(allocations() - before, 0u);
  EXPECT_GT(world.report().pairs, 300u);
}

// Automatic bodies that are fast now and then.
TEST(Allocations, NoneWhenBodiesAreFastAndSlowInTurns) {
  World world;
  const std::vector<BodyId> ids = add_crowd(world, {});
  for (const BodyId id : ids) world.set_detection(id, Detection::automatic);
  const auto round = [&] {
    for (const float speed : {0.0f, 90.0f, 1.0f}) {
      for (Eigen::Vector3f& v : world.linear_velocities()) v = {speed, 0, 0};
      world.step();
    }
  };
  for (int i = 0; i < 4; ++i) round();
  const size_t before = allocations();
  for (int i = 0; i < 10; ++i) round();
  EXPECT_EQ(allocations() - before, 0u);
}

// Bodies become invalid, recover, are removed and replaced.
TEST(Allocations, NoneWhenBodiesAreReplacedOrSpoilt) {
  const CrowdSpec spec{.oriented = true, .halfspaces = 6};
  World world;
  std::vector<BodyId> ids = add_crowd(world, spec);
  const std::vector<BodyDesc> crowd = make_crowd(spec);
  const auto round = [&] {
    for (const double x : {std::nan(""), 1.0}) {
      world.set_position(ids[3], {x, 1, 1});
      world.remove(ids[5]);
      ids[5] = world.add(crowd[5]);
      world.remove(ids.back());  // the last row disappears and comes back
      world.step();
      ids.back() = world.add(crowd.back());
      world.step();
    }
  };
  for (int i = 0; i < 4; ++i) round();
  const size_t before = allocations();
  for (int i = 0; i < 10; ++i) round();
  EXPECT_EQ(allocations() - before, 0u);
}

}  // namespace
}  // namespace carom::test

#endif  // defined(CAROM_TEST_COUNTS_MALLOC)
