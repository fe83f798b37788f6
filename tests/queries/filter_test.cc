// Filters and predicates keep exactly the hits that they name; any-hit says which queries hit.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include "carom/base/function_ref.h"
#include "carom/base/thread_arena.h"
#include "carom/queries/cast.h"
#include "carom/queries/queries.h"
#include "tests/support/cast_checks.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

constexpr size_t kBodies = 300;

struct Scene {
  std::vector<PlacedShape> queries, bodies;
  Sweeps sweeps;
  std::vector<uint32_t> layer, mask, owner, space;
  std::vector<int32_t> group;
  LaidOut a, b;

  explicit Scene(size_t count = 100, uint64_t seed = 1)
      : queries(make_bodies({.count = count}, seed)),
        bodies(make_bodies({.count = kBodies}, seed + 1)),
        sweeps(make_sweeps(count, 5, true, 3)),
        a(queries, {}),
        b(bodies, {}) {
    oracle::Random random(4);
    for (size_t i = 0; i < kBodies; ++i) {
      layer.push_back(1u << random.below(4));
      mask.push_back(static_cast<uint32_t>(random.below(16)));
      owner.push_back(static_cast<uint32_t>(random.below(4)));
      space.push_back(static_cast<uint32_t>(random.below(3)));
      group.push_back(static_cast<int32_t>(random.below(5)) - 2);
    }
  }

  std::vector<CastHit> cast(const CastOptions& options) const {
    std::vector<CastHit> hits;
    EXPECT_TRUE(bool(carom::cast(a.view(), sweeps.view(), b.view(), hits, options)));
    return hits;
  }
};

template <class Keep>
std::vector<CastHit> kept(std::vector<CastHit> hits, const Keep& keep) {
  std::erase_if(hits, [&](const CastHit& hit) { return !keep(hit.query, hit.body); });
  return hits;
}

TEST(QueryFilter, OfLayersMasksAndOwners) {
  const Scene scene(rounds(100, 25));
  const std::vector<CastHit> everything = scene.cast({.hits = CastHits::all});
  const PairFilter columns = {
      .layer = scene.layer.data(), .mask = scene.mask.data(), .owner = scene.owner.data()};
  for (const uint32_t mask : {~0u, 0u, 5u}) {
    for (const uint32_t layer : {0u, 2u, 12u}) {
      for (const uint32_t owner : {0u, 3u}) {
        const auto keep = [&](uint32_t, uint32_t body) {
          return (scene.layer[body] & mask) != 0 &&
                 (layer == 0 || (scene.mask[body] & layer) != 0) &&
                 (owner == 0 || scene.owner[body] != owner);
        };
        const QueryFilter filter = {
            .mask = mask, .layer = layer, .owner = owner, .bodies = columns};
        const std::vector<CastHit> expected = kept(everything, keep);
        EXPECT_EQ(expected.empty(), mask == 0);
        EXPECT_EQ(bits_of(scene.cast({.hits = CastHits::all, .filter = filter})),
                  bits_of(expected));
        EXPECT_EQ(bits_of(scene.cast({.filter = filter})), bits_of(closest_of(expected)));
      }
    }
  }
}

// One rule at a time, so that each is seen to decide something.
TEST(QueryFilter, OfEachRule) {
  const Scene scene(rounds(100, 25));
  const std::vector<CastHit> everything = scene.cast({.hits = CastHits::all});
  const PairFilter columns = {.layer = scene.layer.data(),
                              .mask = scene.mask.data(),
                              .owner = scene.owner.data(),
                              .group = scene.group.data(),
                              .space = scene.space.data()};
  std::vector<Pair> excluded;
  for (size_t i = 0; i < everything.size(); i += 2) {
    excluded.push_back({everything[i].query, everything[i].body});
  }
  std::sort(excluded.begin(), excluded.end());
  struct Rule {
    QueryFilter filter;
    FunctionRef<bool(Pair)> keeps;
  };
  const auto in_mask = [&](Pair pair) { return (scene.layer[pair.b] & 3) != 0; };
  const auto has_layer = [&](Pair pair) { return (scene.mask[pair.b] & 2) != 0; };
  const auto either = [&](Pair pair) { return in_mask(pair) || has_layer(pair); };
  const auto negative = [&](Pair pair) { return scene.group[pair.b] != -1; };
  const auto positive = [&](Pair pair) { return scene.group[pair.b] == 2 || in_mask(pair); };
  const auto first_space = [&](Pair pair) { return scene.space[pair.b] == 0; };
  const auto last_space = [&](Pair pair) { return scene.space[pair.b] == 2; };
  const auto not_listed = [&](Pair pair) { return !std::ranges::binary_search(excluded, pair); };
  // Before the layers: a body of the same owner is not met although it is in the same group.
  const auto not_owned = [&](Pair pair) { return scene.owner[pair.b] != 1 && positive(pair); };
  const Rule rules[] = {{{.mask = 3, .layer = 2, .rule = FilterRule::either}, either},
                        {{.mask = 3, .rule = FilterRule::either}, in_mask},
                        {{.mask = 0, .layer = 2, .rule = FilterRule::either}, has_layer},
                        {{.group = -1}, negative},
                        {{.mask = 3, .group = 2}, positive},
                        {{.space = 0}, first_space},
                        {{.space = 2}, last_space},
                        {{.excluded = excluded}, not_listed},
                        {{.mask = 3, .owner = 1, .group = 2}, not_owned}};
  for (const Rule& rule : rules) {
    const auto keep = [&](uint32_t query, uint32_t body) { return rule.keeps({query, body}); };
    const std::vector<CastHit> expected = kept(everything, keep);
    EXPECT_GT(expected.size(), everything.size() / 8);
    EXPECT_LT(expected.size(), everything.size() * 15 / 16);
    QueryFilter filter = rule.filter;
    filter.bodies = columns;
    EXPECT_EQ(bits_of(scene.cast({.hits = CastHits::all, .filter = filter})), bits_of(expected));
    EXPECT_EQ(bits_of(scene.cast({.filter = filter})), bits_of(closest_of(expected)));
  }
}

// Without columns all bodies have a full mask, no group, and are in space 0.
TEST(QueryFilter, OfBodiesWithoutProperties) {
  const Scene scene(rounds(100, 25));
  const std::string everything = bits_of(scene.cast({.hits = CastHits::all}));
  const QueryFilter of_all[] = {{.layer = 2},
                                {.mask = 0, .layer = 1, .rule = FilterRule::either},
                                {.owner = 5},
                                {.group = -1},
                                {.space = 0}};
  for (const QueryFilter& filter : of_all) {
    EXPECT_EQ(bits_of(scene.cast({.hits = CastHits::all, .filter = filter})), everything);
  }
  EXPECT_TRUE(scene.cast({.filter = {.space = 1}}).empty());
  EXPECT_TRUE(scene.cast({.filter = {.mask = 0, .rule = FilterRule::either}}).empty());
}

bool is_kept(uint32_t query, uint32_t body) { return (7 * query + body) % 3 == 0; }

void keep_a_third(std::span<const Pair> pairs, std::span<uint8_t> keep) {
  EXPECT_EQ(pairs.size(), keep.size());
  for (size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_EQ(keep[i], 1);
    keep[i] = is_kept(pairs[i].a, pairs[i].b);
  }
}

TEST(QueryFilter, AsksThePredicateOnThreads) {
  const Scene scene;
  const std::vector<CastHit> expected = kept(scene.cast({.hits = CastHits::all}), is_kept);
  std::vector<OverlapHit> overlaps, all_overlaps;
  std::vector<NearestHit> nearest, again;
  ASSERT_TRUE(bool(find_overlaps(scene.a.view(), scene.b.view(), all_overlaps)));
  std::erase_if(all_overlaps, [](const OverlapHit& hit) { return !is_kept(hit.query, hit.body); });
  EXPECT_GT(expected.size(), 100u);
  for (const int threads : {1, 2, 4}) {
    ThreadArena arena(threads);
    arena.run([&] {
      const Parallelism parallelism = arena.parallelism();
      const QueryFilter filter = {.predicate = keep_a_third};
      EXPECT_EQ(bits_of(scene.cast(
                    {.hits = CastHits::all, .filter = filter, .parallelism = parallelism})),
                bits_of(expected));
      EXPECT_EQ(bits_of(scene.cast({.filter = filter, .parallelism = parallelism})),
                bits_of(closest_of(expected)));
      ASSERT_TRUE(bool(find_overlaps(scene.a.view(), scene.b.view(), overlaps,
                                     {.filter = filter, .parallelism = parallelism})));
      EXPECT_TRUE(overlaps == all_overlaps);
      ASSERT_TRUE(bool(find_nearest(scene.a.view(), 1, scene.b.view(), again,
                                    {.filter = filter, .parallelism = parallelism})));
    });
    for (const NearestHit& hit : again) EXPECT_TRUE(is_kept(hit.query, hit.body));
    EXPECT_TRUE(threads == 1 || nearest.size() == again.size());
    std::swap(nearest, again);
  }
}

TEST(QueryFilter, PredicateThatIsALambda) {
  const Scene scene;
  std::atomic<size_t> asked = 0;
  const std::vector<CastHit> hits = scene.cast(
      {.filter = {.predicate = [&](std::span<const Pair> pairs, std::span<uint8_t> keep) {
         asked += pairs.size();
         std::fill(keep.begin(), keep.end(), uint8_t{0});
       }}});
  EXPECT_TRUE(hits.empty());
  EXPECT_GT(asked.load(), 100u);
}

TEST(Cast, AnyHitNamesTheQueriesThatHit) {
  const Scene scene(100, 14);  // in which more than a few queries hit nothing
  std::vector<uint32_t> expected, found;
  for (const CastHit& hit : scene.cast({})) expected.push_back(hit.query);
  for (const CastHit& hit : scene.cast({.hits = CastHits::any})) {
    found.push_back(hit.query);
    EXPECT_EQ(hit.body, kNoBody);
    EXPECT_EQ(hit.toi, 0);
    EXPECT_EQ(hit.normal, Eigen::Vector3f::Zero());
  }
  EXPECT_EQ(found, expected);
  EXPECT_GT(found.size(), 20u);
  EXPECT_LT(found.size(), 95u);
}

}  // namespace
}  // namespace carom::test
