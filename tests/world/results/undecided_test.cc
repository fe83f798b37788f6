// Pairs that the certified tier cannot decide: they have no contacts and no events, but stay pairs.
#include <gtest/gtest.h>

#include "tests/support/rounds.h"
#include "tests/world/side_by_side.h"

namespace carom::test {
namespace {

WorldSettings at_tier(Tier tier, WorldSettings settings = {}) {
  settings.accuracy.tier = tier;
  settings.persist_events = true;
  return settings;
}

// R = (3 4 0, -4 3 0, 0 0 5) / 5: the turned box reaches exactly 7 along x and touches the other
// one at 8. Rounding hides on which side.
struct Touching {
  explicit Touching(const WorldSettings& settings, bool sensor = false) : world(settings) {
    world.add({.shape = Box{{1, 1, 1}}, .sensor = sensor});
    turned =
        world.add({.shape = Box{{5, 5, 1}}, .position = {8, 0, 0}, .orientation = {2, 0, 0, 1}});
  }

  const StepReport& step_at(double x) {
    world.set_position(turned, {x, 0, 0});
    return world.step();
  }

  void expect_undecided() {
    EXPECT_EQ(world.report().undecided, 1u);
    EXPECT_EQ(world.report().overlaps, 0u);
    EXPECT_EQ(world.report().contacts, 0u);
    ASSERT_EQ(world.overlaps().size(), 1u);
    EXPECT_EQ(world.overlaps()[0], kUndecided);
    EXPECT_TRUE(world.contacts().empty());
    EXPECT_TRUE(world.manifolds().empty());
  }
  void expect_event(EventKind kind) {
    ASSERT_EQ(world.events().size(), 1u);
    EXPECT_EQ(world.events()[0].kind, kind);
  }

  World world;
  BodyId turned;
};

TEST(Undecided, MakeNeitherContactsNorEvents) {
  for (const Detail detail : {Detail::overlap, Detail::contact, Detail::manifold}) {
    for (const bool sensor : {false, true}) {
      Touching touching(at_tier(Tier::certified, {.detail = detail}), sensor);
      touching.world.step();
      touching.expect_undecided();
      EXPECT_TRUE(touching.world.events().empty());
    }
  }
}

TEST(Undecided, AreReportedAgainWhileNothingMoves) {
  Touching touching(at_tier(Tier::certified));
  const BodyId far = touching.world.add({.shape = Sphere{1}, .position = {50, 0, 0}});
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(touching.world.step().kept, i > 0 ? 1u : 0u);
    touching.expect_undecided();
  }
  touching.world.set_position(far, {51, 0, 0});
  EXPECT_EQ(touching.world.step().kept, 1u);
  touching.expect_undecided();
}

TEST(Undecided, EndWhatOverlappedAndBeginNothing) {
  for (const bool sensor : {false, true}) {
    Touching touching(at_tier(Tier::certified), sensor);
    touching.world.step();
    EXPECT_EQ(touching.step_at(7.5).overlaps, 1u);
    EXPECT_EQ(touching.world.report().undecided, 0u);
    touching.expect_event(EventKind::begin);
    touching.step_at(7.75);
    touching.expect_event(EventKind::persist);
    touching.step_at(8);
    touching.expect_undecided();
    touching.expect_event(EventKind::end);
    EXPECT_EQ(touching.step_at(9).pairs, 0u);
    EXPECT_TRUE(touching.world.events().empty());
    touching.step_at(8);
    touching.expect_undecided();
    touching.world.remove(touching.turned);
    touching.world.step();
    EXPECT_EQ(touching.world.report().undecided, 0u);
    EXPECT_TRUE(touching.world.events().empty());
  }
}

// Separate bounds prove that a pair is separate.
TEST(Undecided, AreNotApartByTheirBounds) {
  Touching touching(at_tier(Tier::certified, {.margin = 1}));
  touching.world.step();
  touching.expect_undecided();
  touching.step_at(8 + 0x1p-20);
  ASSERT_EQ(touching.world.overlaps().size(), 1u);
  EXPECT_EQ(touching.world.overlaps()[0], 0);
  EXPECT_EQ(touching.world.report().undecided, 0u);
}

TEST(Undecided, NoneIsAtTheExactTier) {
  Touching touching(at_tier(Tier::exact));
  EXPECT_EQ(touching.world.step().undecided, 0u);
  EXPECT_EQ(touching.world.report().overlaps, 1u);
  ASSERT_EQ(touching.world.contacts().size(), 1u);
  EXPECT_LE(touching.world.contacts()[0].separation, 0);
  touching.expect_event(EventKind::begin);
}

// Every proven decision equals that of the exact tier, kept or not.
TEST(Undecided, RandomHistoriesOfTheTiersAgree) {
  for (uint64_t seed = 0; seed < rounds(6); ++seed) {
    WorldSettings anew = at_tier(Tier::certified);
    anew.carry_results = false;
    SideBySide worlds(std::vector{at_tier(Tier::exact), at_tier(Tier::certified), anew},
                      {.count = 150,
                       .side = 6,
                       .oriented = true,
                       .halfspaces = 1,
                       .filters = seed % 2 == 0,
                       .seed = seed});
    for (int i = 0; i < 6; ++i) {
      worlds.step();
      ASSERT_TRUE(results(worlds[1]) == results(worlds[2])) << "seed " << seed << ", step " << i;
      ASSERT_EQ(as_bytes(worlds[0].pairs()), as_bytes(worlds[1].pairs()));
      size_t undecided = 0;
      for (size_t k = 0; k < worlds[1].pairs().size(); ++k) {
        const uint8_t decision = worlds[1].overlaps()[k];
        undecided += decision == kUndecided;
        if (decision == kUndecided) continue;
        ASSERT_EQ(decision, worlds[0].overlaps()[k]);
      }
      EXPECT_EQ(worlds[1].report().undecided, undecided);
      worlds.creep(0.05);
      worlds.disturb();
    }
  }
}

}  // namespace
}  // namespace carom::test
