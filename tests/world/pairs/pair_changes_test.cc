// Added and removed pairs against sets of ids.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "carom/base/thread_arena.h"
#include "tests/support/rounds.h"
#include "tests/world/crowds.h"

namespace carom::test {
namespace {

using IdPair = std::pair<BodyId, BodyId>;

// The pairs of the last step by id: a body that replaced another one counts as a different body.
class Model {
 public:
  void check(const World& world) {
    std::set<IdPair> now;
    for (const Pair& pair : world.pairs()) now.emplace(world.id_of(pair.a), world.id_of(pair.b));
    EXPECT_EQ(as_bytes(world.added_pairs()), difference(now, pairs_));
    EXPECT_EQ(as_bytes(world.removed_pairs()), difference(pairs_, now));
    added += world.added_pairs().size();
    removed += world.removed_pairs().size();
    pairs_ = std::move(now);
  }

  size_t added = 0, removed = 0;

 private:
  static std::string difference(const std::set<IdPair>& of, const std::set<IdPair>& without) {
    std::vector<Pair> pairs;
    for (const IdPair& pair : of) {
      if (!without.contains(pair)) pairs.push_back({pair.first.index, pair.second.index});
    }
    return as_bytes<Pair>(pairs);
  }

  std::set<IdPair> pairs_;
};

void run_history(const WorldSettings& settings, const CrowdSpec& spec) {
  World world(settings);
  std::vector<BodyId> ids = add_crowd(world, spec);
  const std::vector<BodyDesc> crowd = make_crowd(spec);
  Random random(spec.seed);
  Model model;
  for (int i = 0; i < 24; ++i) {
    world.step();
    model.check(world);
    if (::testing::Test::HasFailure()) return;
    if (i % 8 < 3) continue;  // still steps
    move_some(world, ids, i % 2 ? 0.05 : 1, random);
    for (int k = 0; k < 6; ++k) {
      const size_t which = random.below(ids.size());
      world.remove(ids[which]);
      const BodyDesc& other = crowd[random.chance(0.5) ? which : random.below(crowd.size())];
      ids[which] = world.add(other);
    }
    if (i % 8 == 6) {
      world.remove(ids.back());
      ids.pop_back();
      world.set_position(ids[0], {std::nan(""), 0, 0});
    }
  }
  EXPECT_GT(model.added, 100u);
  EXPECT_GT(model.removed, 100u);
}

TEST(PairChanges, MatchSetsOfPairs) {
  for (uint64_t seed = 1; seed <= rounds(90, 8); ++seed) {
    WorldSettings settings{.pair_changes = true};
    settings.detail = seed % 3 == 0 ? Detail::contact : Detail::pairs;
    settings.events = seed % 2 == 0;
    settings.carry_results = seed % 5 != 0;
    settings.margin = seed % 7 == 0 ? 0.2f : 0.0f;
    run_history(settings, {.count = seed % 4 ? 300u : 1000u,
                           .side = 7,
                           .halfspaces = seed % 2 ? size_t{3} : size_t{0},
                           .seed = seed});
    ASSERT_FALSE(HasFailure()) << seed;
  }
}

TEST(PairChanges, MatchSetsOfPairsOnThreads) {
  ThreadArena arena(4);
  arena.run([&] {
    run_history({.detail = Detail::pairs, .parallelism = arena.parallelism(), .pair_changes = true},
                {.count = 4000, .side = 13});
  });
}

TEST(PairChanges, AReplacedBodyIsAnotherOne) {
  World world({.detail = Detail::pairs, .pair_changes = true});
  const BodyDesc ball{.shape = Sphere{0.5f}};
  const BodyId a = world.add(ball);
  world.add(ball);
  world.step();
  const std::vector<Pair> pair = {{0, 1}};
  const std::string both = as_bytes<Pair>(pair);
  EXPECT_EQ(as_bytes(world.added_pairs()), both);
  EXPECT_TRUE(world.removed_pairs().empty());
  world.step();
  EXPECT_TRUE(world.added_pairs().empty());
  world.remove(a);
  world.add(ball);
  world.step();
  EXPECT_EQ(as_bytes(world.added_pairs()), both);
  EXPECT_EQ(as_bytes(world.removed_pairs()), both);
}

TEST(PairChanges, CostNothingUnlessAskedFor) {
  World without({.detail = Detail::pairs}), with({.detail = Detail::pairs, .pair_changes = true});
  for (World* world : {&without, &with}) {
    add_crowd(*world, {});
    world->step();
  }
  EXPECT_TRUE(without.added_pairs().empty());
  EXPECT_FALSE(without.report().ran(Stage::pairs));
  EXPECT_EQ(with.added_pairs().size(), with.pairs().size());
  EXPECT_TRUE(with.report().ran(Stage::pairs));
  EXPECT_LT(without.memory().pairs_and_results, with.memory().pairs_and_results);
}

}  // namespace
}  // namespace carom::test
