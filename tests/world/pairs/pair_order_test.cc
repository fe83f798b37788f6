// Worlds whose caller does not care in which order pairs come.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/world/side_by_side.h"

namespace carom::test {
namespace {

std::vector<Pair> list_of(std::span<const Pair> pairs) { return {pairs.begin(), pairs.end()}; }

// Steps a world with any order beside one with sorted pairs, and returns how often the first had
// another order.
int count_unsorted(WorldSettings settings, const CrowdSpec& spec, bool excludes = false) {
  WorldSettings any = settings;
  any.pair_order = PairOrder::any;
  SideBySide worlds(std::array{settings, any}, spec);
  int unsorted = 0;
  for (int step = 0; step < 12; ++step) {
    worlds.step();
    const std::vector<Pair> expected = list_of(worlds[0].pairs());
    std::vector<Pair> pairs = list_of(worlds[1].pairs());
    unsorted += !std::ranges::is_sorted(pairs);
    std::ranges::sort(pairs);
    EXPECT_EQ(pairs, expected);
    EXPECT_GT(pairs.size(), 100u);
    if (excludes && step == 5) {
      for (size_t i = 0; i < 2; ++i) worlds[i].exclude(std::span(expected).first(5));
    }
    step % 3 == 0 ? worlds.creep(0.1) : worlds.disturb();
  }
  return unsorted;
}

TEST(PairOrder, AnyHasTheSamePairs) {
  EXPECT_EQ(count_unsorted({.detail = Detail::pairs}, {.count = 2000, .side = 10}), 12);
  EXPECT_EQ(count_unsorted({.detail = Detail::pairs, .carry_results = false},
                           {.count = 2000, .side = 10}),
            12);
}

TEST(PairOrder, IsSortedWhereOrderIsNeeded) {
  const CrowdSpec crowd = {.count = 1000, .side = 8};
  EXPECT_EQ(count_unsorted({.detail = Detail::contact}, crowd), 0);
  EXPECT_EQ(count_unsorted({.detail = Detail::overlap, .events = false}, crowd), 0);
  EXPECT_EQ(count_unsorted({.detail = Detail::pairs, .pair_changes = true}, crowd), 0);
  CrowdSpec with_floor = crowd;
  with_floor.halfspaces = 2;
  EXPECT_EQ(count_unsorted({.detail = Detail::pairs}, with_floor), 0);
  // The pairs are excluded after the sixth step.
  EXPECT_EQ(count_unsorted({.detail = Detail::pairs}, crowd, true), 6);
}

}  // namespace
}  // namespace carom::test
