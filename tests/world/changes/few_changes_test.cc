// Worlds in which a few bodies change in each step: bounds, pairs and results of all others are
// kept. A world that keeps nothing has the same.
#include <gtest/gtest.h>

#include "carom/base/thread_arena.h"
#include "tests/support/rounds.h"
#include "tests/world/side_by_side.h"

namespace carom::test {
namespace {

// How often the histories took what they are for.
struct Coverage {
  size_t steps = 0;
  size_t mostly_kept = 0;  // steps that kept nine pairs of ten and tested some
  size_t begins = 0, ends = 0;
  size_t quarantined = 0;
  size_t near = 0;  // contacts between bodies that do not touch
};

WorldSettings few_changes_settings(uint64_t seed) {
  constexpr Detail kDetails[] = {Detail::overlap, Detail::contact, Detail::manifold,
                                 Detail::regions};
  WorldSettings settings = varied_settings(seed);
  settings.detail = kDetails[seed % 4];
  settings.identities = seed % 8 > 4;
  settings.persist_events = seed % 3 == 1;
  settings.pair_changes = seed % 5 == 2;
  if (seed % 7 == 3) settings.dop_bounds = DopKind::k14;
  if (seed % 7 == 5) settings.margin = 0.05f;
  if (seed % 9 == 2) settings.contact_distance = 0.05f;
  return settings;
}

void expect_same(const World& kept, const World& anew) {
  ASSERT_EQ(as_bytes(kept.pairs()), as_bytes(anew.pairs()));
  ASSERT_EQ(as_bytes(kept.overlaps()), as_bytes(anew.overlaps()));
  ASSERT_EQ(as_bytes(kept.contacts()), as_bytes(anew.contacts()));
  ASSERT_EQ(as_bytes(kept.manifolds()), as_bytes(anew.manifolds()));
  ASSERT_EQ(as_bytes(kept.identities()), as_bytes(anew.identities()));
  ASSERT_EQ(as_bytes(kept.events()), as_bytes(anew.events()));
  ASSERT_EQ(as_bytes(kept.added_pairs()), as_bytes(anew.added_pairs()));
  ASSERT_EQ(as_bytes(kept.removed_pairs()), as_bytes(anew.removed_pairs()));
  ASSERT_EQ(as_bytes(kept.quarantined()), as_bytes(anew.quarantined()));
  const StepReport &a = kept.report(), &b = anew.report();
  ASSERT_EQ(a.overlaps, b.overlaps);
  ASSERT_EQ(a.undecided, b.undecided);
  ASSERT_EQ(a.left_out, b.left_out);
}

// Changes that SideBySide does not know.
void change_more(SideBySide& worlds, Random& random) {
  const uint32_t index = static_cast<uint32_t>(random.below(worlds[0].pairs().size() / 2 + 1));
  if (!worlds[0].is_alive(index)) return;
  const BodyId id = worlds[0].id_of(index);
  const uint64_t what = random.below(8);
  const float distance = random.chance(0.5) ? 0.1f : 0.0f;
  for (size_t i = 0; i < 2; ++i) {
    World& world = worlds[i];
    if (what == 0) world.set_position(id, {std::nan(""), 0, 0});
    if (what == 1) world.set_position(id, {1, 2, 3});
    if (what == 2) world.set_contact_distance(id, distance);
    if (what == 3) world.set_detection(id, distance > 0 ? Detection::swept : Detection::discrete);
    if (what == 4) world.set_group(id, distance > 0 ? -1 : 0);
    if (what == 5) world.set_motion(id, distance > 0 ? Motion::fixed : Motion::dynamic);
  }
}

void run_few_changes(uint64_t seed, size_t bodies, Parallelism parallelism, Coverage& coverage) {
  WorldSettings keeps = few_changes_settings(seed);
  keeps.parallelism = parallelism;
  WorldSettings anew = keeps;
  anew.carry_results = false;
  CrowdSpec spec = varied_crowd(seed, bodies);
  SideBySide worlds(std::array{keeps, anew}, spec);
  Random random(seed);
  for (int step = 0; step < 25; ++step) {
    if (step > 1 && random.chance(0.9)) worlds.disturb();
    if (step > 1 && seed % 2 == 0 && random.chance(0.5)) change_more(worlds, random);
    worlds.step();
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", step " << step);
    ASSERT_NO_FATAL_FAILURE(expect_same(worlds[0], worlds[1]));
    const StepReport& report = worlds[0].report();
    ++coverage.steps;
    coverage.mostly_kept += report.tested > 0 && 10 * report.kept > 9 * report.pairs;
    for (const Event& event : worlds[0].events()) {
      coverage.begins += event.kind == EventKind::begin;
      coverage.ends += event.kind == EventKind::end;
    }
    coverage.quarantined += !worlds[0].quarantined().empty();
    coverage.near += std::ranges::any_of(worlds[0].contacts(),
                                         [](const Contact& c) { return c.separation > 0; });
  }
}

void expect_all_covered(const Coverage& coverage) {
  EXPECT_GT(2 * coverage.mostly_kept, coverage.steps);
  EXPECT_GT(coverage.begins, coverage.steps);
  EXPECT_GT(coverage.ends, coverage.steps / 2);
  EXPECT_GT(coverage.quarantined, coverage.steps / 50);
  EXPECT_GT(coverage.near, coverage.steps / 50);
}

TEST(FewChanges, GiveTheResultsOfAWorldThatKeepsNothing) {
  Coverage coverage;
  for (uint64_t seed = 0; seed < rounds(60, 20); ++seed) {
    const size_t bodies = seed % 3 == 0 ? 700 : seed % 3 == 1 ? 150 : 60;
    ASSERT_NO_FATAL_FAILURE(run_few_changes(seed, bodies, Parallelism::none, coverage));
  }
  expect_all_covered(coverage);
}

// Enough bodies for several blocks of pairs, and for threads.
TEST(FewChanges, InLargeWorldsOnThreads) {
  ThreadArena arena(3);
  arena.run([&] {
    Coverage coverage;
    for (uint64_t seed = 100; seed < 104; ++seed) {
      ASSERT_NO_FATAL_FAILURE(run_few_changes(seed, 4000, arena.parallelism(), coverage));
    }
    EXPECT_GT(2 * coverage.mostly_kept, coverage.steps);
  });
}

}  // namespace
}  // namespace carom::test
