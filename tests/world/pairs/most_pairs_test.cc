// Steps with more pairs than the limit: they are empty and consistent, and end when the bodies
// separate.
#include <gtest/gtest.h>

#include "tests/world/crowds.h"

namespace carom::test {
namespace {

constexpr size_t kLimit = 1000;

// Bodies in a row, each overlapping the next, or all in one place.
class Heap {
 public:
  Heap(WorldSettings settings, size_t count) {
    settings.most_pairs = kLimit;
    settings.pair_changes = true;
    settings.persist_events = true;
    world = World(settings);
    for (size_t i = 0; i < count; ++i) ids.push_back(world.add({.shape = Sphere{0.6f}}));
    spread();
  }

  void spread() {
    for (size_t i = 0; i < ids.size(); ++i) world.set_position(ids[i], {double(i), 0, 0});
  }
  void pile_up() {
    for (const BodyId id : ids) world.set_position(id, {0, 0, 0});
  }

  void expect_row(EventKind kind) {
    const StepReport& report = world.step();
    EXPECT_TRUE(report.search.complete);
    EXPECT_EQ(report.pairs, ids.size() - 1);
    if (world.settings().detail == Detail::pairs) return;
    EXPECT_EQ(world.contacts().size(), ids.size() - 1);
    EXPECT_EQ(world.events().size(), ids.size() - 1);
    for (const Event& event : world.events()) EXPECT_EQ(event.kind, kind);
  }

  void expect_incomplete(size_t ended) {
    const StepReport& report = world.step();
    EXPECT_FALSE(report.search.complete);
    EXPECT_GT(report.search.pairs, kLimit);
    EXPECT_EQ(report.pairs + report.overlaps + report.contacts + report.tested + report.kept, 0u);
    EXPECT_TRUE(world.pairs().empty());
    EXPECT_TRUE(world.overlaps().empty());
    EXPECT_TRUE(world.contacts().empty());
    EXPECT_TRUE(world.added_pairs().empty());
    EXPECT_EQ(world.removed_pairs().size(), ended);
    EXPECT_EQ(report.bodies, ids.size());
    if (world.settings().detail == Detail::pairs) return;
    EXPECT_EQ(world.events().size(), ended);
    for (const Event& event : world.events()) EXPECT_EQ(event.kind, EventKind::end);
  }

  World world;
  std::vector<BodyId> ids;
};

TEST(MostPairs, AnIncompleteStepIsEmptyAndTheNextBeginsAnew) {
  for (const Detail detail : {Detail::pairs, Detail::contact}) {
    for (const BroadphaseMethod method :
         {BroadphaseMethod::brute, BroadphaseMethod::sweep, BroadphaseMethod::grid}) {
      for (const bool carry : {true, false}) {
        SCOPED_TRACE(::testing::Message() << name(method) << (carry ? "" : ", nothing carried"));
        Heap heap({.detail = detail, .broadphase = method, .carry_results = carry}, 100);
        heap.expect_row(EventKind::begin);
        heap.pile_up();
        heap.expect_incomplete(99);
        for (int i = 0; i < 6; ++i) heap.expect_incomplete(0);  // still steps, too
        heap.spread();
        heap.expect_row(EventKind::begin);
        heap.expect_row(EventKind::persist);
        for (int i = 0; i < 6; ++i) heap.expect_row(EventKind::persist);
        heap.pile_up();
        heap.expect_incomplete(99);
      }
    }
  }
}

TEST(MostPairs, TheFirstStepMayBeIncomplete) {
  Heap heap({}, 100);
  heap.pile_up();
  heap.expect_incomplete(0);
  heap.spread();
  heap.expect_row(EventKind::begin);
}

TEST(MostPairs, AsManyAsAreAllowedAreComplete) {
  World world({.most_pairs = 45});
  for (int i = 0; i < 10; ++i) world.add({.shape = Sphere{1}});
  EXPECT_TRUE(world.step().search.complete);
  EXPECT_EQ(world.contacts().size(), 45u);
  world.add({.shape = Sphere{1}});
  EXPECT_FALSE(world.step().search.complete);
  EXPECT_EQ(world.report().search.pairs, 55u);
}

}  // namespace
}  // namespace carom::test
