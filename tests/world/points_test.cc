// Which bodies contain a point: against every body one by one.
#include <gtest/gtest.h>

#include <algorithm>

#include "carom/base/thread_arena.h"
#include "carom/reference/reference.h"
#include "tests/support/float_modes.h"
#include "tests/support/isas.h"
#include "tests/support/rounds.h"
#include "tests/world/crowds.h"

namespace carom::test {
namespace {

struct Point {
  float x, y, z;
  float more[3] = {};
};

std::vector<Point> make_points(const World& world, std::span<const BodyId> ids, double side,
                               size_t count) {
  Random random(7);
  std::vector<Point> points;
  for (size_t i = 0; i < count; ++i) {
    const auto at = [&] { return static_cast<float>(random.uniform(-0.5, side + 0.5)); };
    Point point = {at(), at(), at()};
    if (random.chance(0.1)) {
      const Eigen::Vector3f p = world.position(ids[random.below(ids.size())]).cast<float>();
      point = {p.x(), p.y(), p.z()};
    }
    if (random.chance(0.03)) point.y = random.any_float();
    if (random.chance(0.03)) point.z = std::numeric_limits<float>::quiet_NaN();
    if (random.chance(0.03)) point.x = std::numeric_limits<float>::infinity();
    points.push_back(point);
  }
  return points;
}

std::vector<PointHit> plain_hits(const World& world, std::span<const BodyId> ids,
                                 const std::vector<Point>& points) {
  std::vector<PointHit> hits;
  for (uint32_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d at(points[i].x, points[i].y, points[i].z);
    for (const BodyId id : ids) {
      const reference::PairResult result = reference::collide(
          Sphere{0}, {at}, world.shape(id), {world.position(id), world.orientation(id)},
          world.settings().positions);
      if (result.overlap) hits.push_back({i, id.index, result.separation});
    }
  }
  return hits;
}

bool same_hits(std::span<const PointHit> x, std::span<const PointHit> y) {
  return as_bytes(x) == as_bytes(y);
}

void expect_hits(const World& world, std::span<const BodyId> ids, double side,
                 size_t count = rounds(300, 60)) {
  const std::vector<Point> points = make_points(world, ids, side, count);
  const std::vector<PointHit> expected = plain_hits(world, ids, points);
  std::vector<PointHit> hits = {{1, 2, 3}};
  world.find_points(reinterpret_cast<const float*>(points.data()), points.size(), sizeof(Point),
                    hits);
  EXPECT_TRUE(same_hits(hits, expected)) << hits.size() << " hits instead of " << expected.size();
}

TEST(FindPoints, InSpheresAndBoxes) {
  for_each_isa([] {
    for (const size_t count : {1, 2, 17, 400}) {
      World world;
      const std::vector<BodyId> ids = add_crowd(world, {.count = count});
      world.step();
      expect_hits(world, ids, 7);
      expect_hits(world, ids, 7, 1);
      expect_hits(world, ids, 7, 0);
    }
  });
}

TEST(FindPoints, InBodiesOfAllKinds) {
  for_each_isa([] {
    for (const size_t halfspaces : {0, 1, 5}) {
      for (const PositionType positions : {PositionType::float32, PositionType::float64}) {
        World world({.positions = positions});
        std::vector<BodyId> ids = add_crowd(world, {.oriented = true, .halfspaces = halfspaces});
        ids.push_back(world.add({.shape = Halfspace{{1, 0, 0}, 2}}));
        ids.push_back(world.add({.shape = Halfspace{{0, 0, 0}, 2}}));
        world.step();
        expect_hits(world, ids, 7);
        for (int i = 0; i < 3; ++i) world.step();
        expect_hits(world, ids, 7, 1);
        world.remove(ids[0]);
        ids.erase(ids.begin());
        world.step();
        expect_hits(world, ids, 7);
      }
    }
  });
}

TEST(FindPoints, FiltersAndSensorsDoNotMatter) {
  World world;
  const std::vector<BodyId> ids = add_crowd(world, {.filters = true});
  world.step();
  expect_hits(world, ids, 7);
}

TEST(FindPoints, SkipsRemovedAndQuarantinedBodies) {
  World world;
  std::vector<BodyId> ids = add_crowd(world, {});
  for (const size_t i : {3, 10, 200}) world.remove(ids[i]);
  world.set_position(ids[5], {std::nan(""), 0, 0});
  world.set_shape(ids[6], Sphere{-1});
  std::erase_if(ids, [&](BodyId id) { return !world.contains(id); });
  world.step();
  expect_hits(world, ids, 7);
}

TEST(FindPoints, InAFloat64World) {
  World world({.positions = PositionType::float64});
  const std::vector<BodyId> ids = add_crowd(world, {});
  world.step();
  expect_hits(world, ids, 7);
}

TEST(FindPoints, AfterAStillStep) {
  World world;
  const std::vector<BodyId> ids = add_crowd(world, {});
  for (int i = 0; i < 3; ++i) world.step();
  expect_hits(world, ids, 7);
}

TEST(FindPoints, OnThreads) {
  ThreadArena arena(4);
  arena.run([] {
    World world;
    const std::vector<BodyId> ids = add_crowd(world, {.count = 6000, .side = 16});
    world.step();
    expect_hits(world, ids, 16);
  });
}

TEST(FindPoints, OfAnEmptyWorld) {
  World world;
  std::vector<PointHit> hits = {{1, 2, 3}};
  const Point point = {0, 0, 0};
  world.find_points(&point.x, 1, sizeof(Point), hits);
  EXPECT_TRUE(hits.empty());
  world.step();
  world.find_points(&point.x, 1, sizeof(Point), hits);
  EXPECT_TRUE(hits.empty());
}

TEST(FindPoints, InBodiesThatTheFilterKeeps) {
  World world;
  const std::vector<BodyId> ids = add_crowd(world, {.count = 400});
  for (size_t i = 0; i < ids.size(); ++i) {
    world.set_filter(ids[i], 1u << (i % 3), 7, 0);
    world.set_space(ids[i], static_cast<uint32_t>(i % 2));
  }
  world.step();
  const std::vector<Point> points = make_points(world, ids, 7, 300);
  const std::vector<PointHit> everything = plain_hits(world, ids, points);
  const auto drop_a_third = [](std::span<const Pair> pairs, std::span<uint8_t> keep) {
    for (size_t i = 0; i < pairs.size(); ++i) keep[i] = (pairs[i].a + pairs[i].b) % 3 != 0;
  };
  std::vector<PointHit> expected, hits;
  for (const PointHit& hit : everything) {
    const bool keeps = hit.body % 3 != 1 && hit.body % 2 == 1 && (hit.point + hit.body) % 3 != 0;
    if (keeps) expected.push_back(hit);
  }
  EXPECT_GT(expected.size(), 10u);
  world.find_points(reinterpret_cast<const float*>(points.data()), points.size(), sizeof(Point),
                    hits, {.filter = {.mask = 5, .space = 1, .predicate = drop_a_third}});
  EXPECT_TRUE(same_hits(hits, expected)) << hits.size() << " hits instead of " << expected.size();
}

// Points with subnormal coordinates, which flush-to-zero would make equal.
TEST(FindPoints, InAnyFloatMode) {
  const float unit = 0x1p-149f;
  World world;
  std::vector<BodyId> ids;
  for (int i = 0; i < 40; ++i) {
    ids.push_back(world.add({.shape = Sphere{3 * unit}, .position = {10.0 * i * unit, 0, 0}}));
  }
  world.step();
  std::vector<Point> points;
  for (int i = 399; i >= 0; --i) points.push_back({static_cast<float>(i) * unit, 0, 0});
  const std::vector<PointHit> expected = plain_hits(world, ids, points);
  EXPECT_GT(expected.size(), 200u);
  for (const FloatMode& mode : float_modes()) {
    std::vector<PointHit> hits;
    {
      const ScopedFloatMode scoped(mode);
      world.find_points(reinterpret_cast<const float*>(points.data()), points.size(), sizeof(Point),
                        hits);
    }
    EXPECT_TRUE(same_hits(hits, expected))
        << mode.name << ": " << hits.size() << " hits instead of " << expected.size();
  }
}

}  // namespace
}  // namespace carom::test
