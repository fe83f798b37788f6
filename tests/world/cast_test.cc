// Casts, overlaps and nearest bodies in a world equal those of the same bodies as arrays.
#include <gtest/gtest.h>

#include "carom/base/thread_arena.h"
#include "tests/support/cast_checks.h"
#include "tests/world/crowds.h"

namespace carom::test {
namespace {

// The living bodies that a query may meet, as arrays, and the index of each.
struct AsArrays {
  std::vector<PlacedShape> bodies;
  std::vector<uint32_t> index;
};

AsArrays as_arrays(const World& world, std::span<const BodyId> ids) {
  AsArrays result;
  for (const BodyId id : ids) {
    result.bodies.push_back({world.shape(id), world.position(id), world.orientation(id)});
    result.index.push_back(id.index);
  }
  return result;
}

template <class Hit>
std::vector<Hit> with_indices(std::vector<Hit> hits, const AsArrays& arrays) {
  for (Hit& hit : hits) hit.body = arrays.index[hit.body];
  return hits;
}

std::vector<Eigen::Vector3f> vectors_of(const NearestHit& hit) {
  return {hit.normal, hit.point_query, hit.point_body};
}

bool are_same(const std::vector<NearestHit>& x, const std::vector<NearestHit>& y) {
  return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                    [](const NearestHit& a, const NearestHit& b) {
                      return a.query == b.query && a.body == b.body && a.sub_shape == b.sub_shape &&
                             a.separation == b.separation && vectors_of(a) == vectors_of(b) &&
                             a.status == b.status;
                    });
}

// `ids`, which ascend by index, are the bodies that queries may meet.
void expect_cast_hits(const World& world, std::span<const BodyId> ids, uint32_t mask = ~0u) {
  const PositionType positions = world.settings().positions;
  const Parallelism parallelism = world.settings().parallelism;
  const AsArrays arrays = as_arrays(world, ids);
  const std::vector<PlacedShape> queries =
      make_bodies({.count = 50, .side = 7, .positions = positions}, 3);
  const Sweeps sweeps = make_sweeps(queries.size(), 6, true, 4);
  const LaidOut a(queries, {.positions = positions});
  const LaidOut b(arrays.bodies, {.positions = positions});

  for (const CastHits which : {CastHits::all, CastHits::closest}) {
    std::vector<CastHit> expected, hits(1);
    ASSERT_TRUE(bool(cast(a.view(), sweeps.view(), b.view(), expected, {.hits = which})));
    world.cast(a.view(), sweeps.view(), hits,
               {.hits = which, .filter = {.mask = mask}, .parallelism = parallelism});
    EXPECT_TRUE(bits_of(hits) == bits_of(with_indices(expected, arrays)))
        << show(hits, with_indices(expected, arrays));
  }
  std::vector<OverlapHit> expected_overlaps, overlaps(1);
  ASSERT_TRUE(bool(find_overlaps(a.view(), b.view(), expected_overlaps)));
  world.find_overlaps(a.view(), overlaps, {.filter = {.mask = mask}, .parallelism = parallelism});
  EXPECT_TRUE(overlaps == with_indices(expected_overlaps, arrays));
  for (const float within : {0.2f, std::numeric_limits<float>::infinity()}) {
    std::vector<NearestHit> expected_nearest, nearest(1);
    ASSERT_TRUE(bool(find_nearest(a.view(), within, b.view(), expected_nearest)));
    world.find_nearest(a.view(), within, nearest,
                       {.filter = {.mask = mask}, .parallelism = parallelism});
    EXPECT_TRUE(are_same(nearest, with_indices(expected_nearest, arrays)));
  }
}

CrowdSpec crowd(size_t count, size_t halfspaces) {
  return {.count = count, .oriented = true, .halfspaces = halfspaces};
}

std::vector<BodyId> add_composites(World& world, size_t count, std::vector<BodyId> ids) {
  Composites composites(3);
  for (size_t i = 0; i < count; ++i) {
    BodyDesc body;
    body.shape = i % 2 ? Shape(composites.mesh(0.8)) : Shape(composites.compound(0.8));
    body.orientation = composites.orientation();
    body.position = random_position(composites.random(), 7);
    ids.push_back(world.add(body));
  }
  return ids;
}

TEST(WorldQueries, AreThoseOfArrays) {
  for_each_isa([] {
    for (const size_t halfspaces : {0, 3}) {
      for (const PositionType positions : {PositionType::float32, PositionType::float64}) {
        World world({.positions = positions});
        const std::vector<BodyId> ids =
            add_composites(world, 20, add_crowd(world, crowd(150, halfspaces)));
        world.step();
        expect_cast_hits(world, ids);
      }
    }
  });
}

TEST(WorldQueries, OfEveryStep) {
  for (const float margin : {0.0f, 0.3f}) {
    World world({.margin = margin});
    std::vector<BodyId> ids = add_crowd(world, crowd(120, 2));
    Random random(1);
    for (int step = 0; step < 6; ++step) {
      if (step != 3) {  // in one step nothing moves
        move_some(world, ids, 0.5, random);
        turn_some(world, ids, 0.5, random);
      }
      if (step == 4) {
        world.remove(ids[5]);
        world.remove(ids[0]);
        ids.erase(ids.begin() + 5);
        ids.erase(ids.begin());
      }
      world.step();
      expect_cast_hits(world, ids);
    }
  }
}

TEST(WorldQueries, MeetTheLayersOfTheMask) {
  World world;
  const std::vector<BodyId> ids = add_crowd(world, {.oriented = true, .filters = true});
  const std::vector<BodyDesc> bodies = make_crowd({.oriented = true, .filters = true});
  world.step();
  for (const uint32_t mask : {0u, 1u, 2u, 6u, ~0u}) {
    std::vector<BodyId> met;
    for (size_t i = 0; i < ids.size(); ++i) {
      if (bodies[i].layer & mask) met.push_back(ids[i]);
    }
    expect_cast_hits(world, met, mask);
  }
}

TEST(WorldQueries, WithoutLayersTheMaskMeetsAllOrNothing) {
  World world;
  const std::vector<BodyId> ids = add_crowd(world, crowd(100, 1));
  world.step();
  expect_cast_hits(world, ids, 4);
  expect_cast_hits(world, {}, 0);
}

TEST(WorldQueries, SkipQuarantinedBodies) {
  World world;
  const std::vector<BodyId> ids = add_crowd(world, crowd(200, 3));
  world.set_position(ids[7], {std::nan(""), 0, 0});
  world.set_position(ids[1], {0, INFINITY, 0});  // body 1 is a half-space
  world.set_shape(ids[9], Sphere{-1});
  world.step();
  EXPECT_EQ(world.quarantined().size(), 3u);
  expect_cast_hits(world, ids);
}

TEST(WorldQueries, OfAnEmptyWorld) {
  World world;
  expect_cast_hits(world, {});
  world.step();
  expect_cast_hits(world, {});
  const std::vector<BodyId> ids = add_crowd(world, crowd(20, 0));
  world.step();
  expect_cast_hits(world, ids);
  world.remove(ids);
  world.step();
  expect_cast_hits(world, {});
}

TEST(WorldQueries, OnThreads) {
  ThreadArena arena(4);
  arena.run([] {
    World world;
    const std::vector<BodyId> ids = add_crowd(world, {.count = 6000, .side = 16});
    world.step();
    expect_cast_hits(world, ids);
  });
}

TEST(WorldQueries, TheirMemoryIsCounted) {
  World world;
  add_crowd(world, {.count = 1000});
  world.step();
  const size_t before = world.memory().bounds;
  std::vector<OverlapHit> hits;
  world.find_overlaps({}, hits);
  EXPECT_GT(world.memory().bounds, before + 1000 * 28);
}

}  // namespace
}  // namespace carom::test
