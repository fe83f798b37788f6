#include "tests/world/histories.h"

#include "carom/base/thread_arena.h"
#include "carom/simd/isa.h"
#include "tests/support/rounds.h"

namespace carom {
namespace {

using test::History;
using test::Kinds;

// Runs a history with changes of every kind, at random rates.
void run_history(const WorldSettings& settings, uint32_t seed, int steps,
                 test::Coverage* coverage = nullptr, Kinds kinds = Kinds::spheres_and_aabbs) {
  SCOPED_TRACE(::testing::Message() << "seed " << seed);
  History history(settings, seed, kinds);
  const bool filters = seed % 3 != 0;
  const double side = history.uniform(2, 8);
  if (coverage) history.coverage = *coverage;
  if (filters && seed % 5 == 0) history.change_predicate();
  const auto churn = [&](double count) { return static_cast<int>(history.uniform(0, count)); };
  for (int i = churn(200); i > 0; --i) history.add(history.random_body(side, filters));
  for (int step = 0; step < steps; ++step) {
    if (history.chance(0.3)) {
      for (int i = churn(20); i > 0; --i) history.add(history.random_body(side, filters));
    }
    if (history.chance(0.3)) {
      for (int i = churn(20); i > 0; --i) history.remove_random();
    }
    if (history.chance(0.2)) history.move(1, side);  // all bodies teleport
    if (history.chance(0.6)) history.move(history.uniform(0, 1), 0.2);
    if (history.chance(0.3)) history.change_random_body(side, filters);
    if (filters && step % 2 == 1) history.change_excluded();
    if (filters && seed % 5 == 0 && step % 5 == 4) history.change_predicate();
    if (kinds == Kinds::all) {
      if (history.chance(0.5)) history.turn(history.uniform(0, 1));
      if (history.chance(0.4)) history.write_rows(history.uniform(0, 0.5));
      if (history.chance(0.3)) history.change_random_body(side, filters);
    }
    history.step_and_check();
    if (::testing::Test::HasFailure()) return;
  }
  if (coverage) *coverage = history.coverage;
}

TEST(History, MatchesReference) {
  test::Coverage coverage;
  for (uint32_t seed = 0; seed < test::rounds(2000); ++seed) {
    WorldSettings settings;
    settings.positions = seed % 2 ? PositionType::float64 : PositionType::float32;
    settings.broadphase = seed % 5 == 0   ? BroadphaseMethod::automatic
                          : seed % 2 == 0 ? BroadphaseMethod::grid
                                          : BroadphaseMethod::sweep;
    settings.carry_results = seed % 7 != 0;
    settings.detail = seed % 4 == 3 ? Detail::overlap : Detail::contact;
    settings.filter_rule = seed % 8 < 3 ? FilterRule::either : FilterRule::both;
    settings.persist_events = seed % 3 != 0;
    run_history(settings, seed, 12, &coverage);
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(coverage.overlapping, coverage.pairs * 3 / 10);
  EXPECT_LT(coverage.overlapping, coverage.pairs * 7 / 10);
  EXPECT_GT(coverage.kept, coverage.pairs / 10);
  EXPECT_GT(coverage.tested, coverage.pairs / 10);
  EXPECT_GT(coverage.quarantined, test::rounds(1000));
  EXPECT_GT(coverage.sensors, test::rounds(1000));
  EXPECT_GT(coverage.excluded, test::rounds(1000));
  EXPECT_GT(coverage.gone, test::rounds(1000));
  for (const EventKind kind : {EventKind::begin, EventKind::persist, EventKind::end}) {
    EXPECT_GT(coverage.events[static_cast<int>(kind)], test::rounds(1000));
  }
}

TEST(History, OfAllKindsMatchesReference) {
  constexpr Detail kDetails[] = {Detail::manifold, Detail::contact, Detail::overlap, Detail::pairs};
  test::Coverage coverage;
  for (uint32_t seed = 0; seed < test::rounds(800); ++seed) {
    WorldSettings settings;
    settings.positions = seed % 2 ? PositionType::float64 : PositionType::float32;
    settings.broadphase = seed % 3 ? BroadphaseMethod::automatic : BroadphaseMethod::grid;
    settings.carry_results = seed % 7 != 0;
    settings.detail = kDetails[seed % 11 < 8 ? 0 : seed % 11 - 7];
    settings.filter_rule = seed % 8 < 3 ? FilterRule::either : FilterRule::both;
    settings.persist_events = seed % 3 != 0;
    run_history(settings, seed, 12, &coverage, Kinds::all);
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(coverage.overlapping, coverage.pairs * 2 / 10);
  EXPECT_LT(coverage.overlapping, coverage.pairs * 8 / 10);
  EXPECT_GT(coverage.kept, coverage.pairs / 20);
  EXPECT_GT(coverage.tested, coverage.pairs / 10);
  EXPECT_GT(coverage.quarantined, test::rounds(1000));
  EXPECT_GT(coverage.sensors, test::rounds(1000));
  EXPECT_GT(coverage.excluded, test::rounds(1000));
  EXPECT_GT(coverage.gone, test::rounds(1000));
  EXPECT_GT(coverage.with_halfspaces, test::rounds(10000));
  EXPECT_GT(coverage.halfspace_overlaps, test::rounds(5000));
  EXPECT_LT(coverage.halfspace_overlaps, coverage.with_halfspaces);
  for (const EventKind kind : {EventKind::begin, EventKind::persist, EventKind::end}) {
    EXPECT_GT(coverage.events[static_cast<int>(kind)], test::rounds(1000));
  }
  for (const size_t count : coverage.manifolds) EXPECT_GT(count, test::rounds(1000));
}

TEST(History, MatchesReferenceOnEveryIsa) {
  const WorldSettings manifold{.detail = Detail::manifold};
  for (const Isa isa : usable_isas()) {
    ASSERT_TRUE(force_isa(isa));
    for (uint32_t seed = 1000; seed < 1020; ++seed) run_history({}, seed, 8);
    for (uint32_t seed = 0; seed < 10; ++seed) run_history(manifold, seed, 8, nullptr, Kinds::all);
  }
  unforce_isa();
}

TEST(History, MatchesReferenceOnThreads) {
  const WorldSettings manifold{.detail = Detail::manifold};
  ThreadArena arena(4);
  arena.run([&] {
    for (uint32_t seed = 2000; seed < 2020; ++seed) run_history({}, seed, 8);
    for (uint32_t seed = 50; seed < 60; ++seed) run_history(manifold, seed, 8, nullptr, Kinds::all);
  });
}

TEST(History, DetailPairsRunsNoNarrowPhase) {
  WorldSettings settings;
  settings.detail = Detail::pairs;
  History history(settings, 1);
  for (int i = 0; i < 300; ++i) history.add(history.random_body(5, true));
  history.step_and_check();
  EXPECT_FALSE(history.world().report().ran(Stage::narrowphase));
  EXPECT_FALSE(history.world().report().ran(Stage::changes));
  EXPECT_FALSE(history.world().report().ran(Stage::events));
  EXPECT_GT(history.world().pairs().size(), 0u);
}

}  // namespace
}  // namespace carom
