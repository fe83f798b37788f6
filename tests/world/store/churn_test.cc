// Bodies come and go for a long time: ids stay right, and memory and work follow the living bodies.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "tests/support/composites.h"
#include "tests/support/pairs.h"
#include "tests/support/rounds.h"
#include "tests/world/crowds.h"
#include "world/store/index_pool.h"

namespace carom::test {
namespace {

BodyDesc body_at(double x, bool box = false) {
  BodyDesc body{.shape = Sphere{0.5f}, .position = {x, 0, 0}};
  if (box) body.shape = Aabb::from_half_extents({0.5f, 0.5f, 0.5f});
  return body;
}

// Body i of a cycle through all kinds but half-spaces.
BodyDesc any_body(size_t i) {
  const Shape shapes[] = {Sphere{0.5f}, Aabb::from_half_extents({0.5f, 0.5f, 0.5f}),
                          Capsule{{0, 0, 0}, {0, 0, 1}, 0.5f}, Box{{0.5f, 0.5f, 0.5f}},
                          Triangle{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}}};
  return {.shape = shapes[i % 5], .position = {4.0 * static_cast<double>(i % 1000), 0, 0}};
}

// Removes `count` random items from the list and returns them.
template <class T>
std::vector<T> draw(std::vector<T>& items, size_t count, Random& random) {
  std::vector<T> drawn;
  for (size_t i = 0; i < count; ++i) {
    std::swap(items[random.below(items.size())], items.back());
    drawn.push_back(items.back());
    items.pop_back();
  }
  return drawn;
}

TEST(IndexPool, HandsOutTheLowestFreeIndexAndEndsAtTheHighestInUse) {
  Random random(1);
  IndexPool pool;
  std::set<uint32_t> used;
  for (int i = 0; i < 20000; ++i) {
    // The population grows and shrinks in turns.
    const double growth = (i / 2000) % 2 ? 0.3 : 0.7;
    if (used.empty() || random.chance(growth)) {
      uint32_t lowest = 0;
      while (used.contains(lowest)) ++lowest;
      ASSERT_EQ(pool.take(), lowest);
      used.insert(lowest);
    } else {
      const auto it = std::next(used.begin(), static_cast<int>(random.below(used.size())));
      pool.release(*it);
      used.erase(it);
    }
    ASSERT_EQ(pool.size(), used.size());
    ASSERT_EQ(pool.end(), used.empty() ? 0 : *used.rbegin() + 1);
    if (i % 50 == 0) {
      std::set<uint32_t> free;
      for (const uint32_t index : pool.free_indices()) EXPECT_TRUE(free.insert(index).second);
      for (uint32_t index = 0; index < pool.end(); ++index) {
        EXPECT_EQ(pool.is_used(index), used.contains(index));
        EXPECT_EQ(free.contains(index), !used.contains(index));
      }
      EXPECT_EQ(free.size(), pool.end() - pool.size());
    }
  }
}

TEST(Churn, AWorldGrowsAndShrinksInBatches) {
  for (const PositionType positions : kPositionTypes) {
    Random random(2);
    World world({.positions = positions});
    std::vector<BodyId> living, dead;
    for (int round = 0; round < 2; ++round) {
      std::vector<BodyDesc> batch;
      while (living.size() < rounds(200000, 50000)) {
        batch.clear();
        for (size_t i = random.below(20000); i > 0; --i) batch.push_back(any_body(i));
        world.add(batch, living);
        const std::vector<BodyId> gone = draw(living, batch.size() / 10, random);
        EXPECT_EQ(world.remove(gone), gone.size());
        dead.insert(dead.end(), gone.begin(), gone.end());
      }
      const size_t peak = world.bytes();
      EXPECT_EQ(world.size(), living.size());
      while (!living.empty()) {
        const size_t count = std::min<size_t>(living.size(), 1 + random.below(20000));
        const std::vector<BodyId> gone = draw(living, count, random);
        EXPECT_EQ(world.remove(gone), gone.size());
        for (const BodyId id : living) ASSERT_TRUE(world.contains(id));
        for (const BodyId id : gone) ASSERT_FALSE(world.contains(id));
        dead.insert(dead.end(), gone.begin(), gone.end());
        uint32_t highest = 0;
        for (const BodyId id : living) highest = std::max(highest, id.index + 1);
        EXPECT_EQ(world.arrays().count, highest);
      }
      EXPECT_EQ(world.size(), 0u);
      EXPECT_EQ(world.arrays().count, 0u);
      EXPECT_EQ(world.boxes().count, 0u);
      EXPECT_EQ(world.shape_rows().count, 0u);
      world.step();
      world.give_back_memory();
      EXPECT_LT(world.bytes(), peak / 20);
    }
    for (int i = 0; i < 1000; ++i) world.add(body_at(i));
    for (const BodyId id : dead) ASSERT_FALSE(world.contains(id));
  }
}

TEST(Churn, NoIdIsEverUsedTwice) {
  Random random(3);
  World world;
  std::vector<BodyId> living;
  std::set<BodyId> seen;
  for (int i = 0; i < 30000; ++i) {
    if (living.empty() || random.chance((i / 300) % 2 ? 0.4 : 0.6)) {
      living.push_back(world.add(body_at(i)));
      EXPECT_TRUE(seen.insert(living.back()).second);
    } else {
      EXPECT_TRUE(world.remove(draw(living, 1, random)[0]));
    }
    if (i % 100 == 0) world.step();
  }
  size_t known = 0;
  for (const BodyId id : seen) known += world.contains(id);
  EXPECT_EQ(known, living.size());
}

// The body with the highest index is removed, and its row with it: its overlaps still end under its
// id.
TEST(Churn, OverlapsOfTheLastBodyEnd) {
  World world;
  const BodyId a = world.add(body_at(0));
  const BodyId b = world.add(body_at(0.5));
  const auto expect_end = [&](BodyId second) {
    ASSERT_GE(world.events().size(), 1u);
    EXPECT_EQ(world.events()[0].kind, EventKind::end);
    EXPECT_EQ(world.events()[0].a, a);
    EXPECT_EQ(world.events()[0].b, second);
  };
  world.step();
  world.remove(b);
  world.step();
  EXPECT_EQ(world.events().size(), 1u);
  expect_end(b);

  const BodyId c = world.add(body_at(0.5));
  EXPECT_NE(c, b);
  world.step();
  world.remove(c);
  const BodyId d = world.add(body_at(0.5));
  EXPECT_NE(d, c);
  world.step();
  EXPECT_EQ(world.events().size(), 2u);
  expect_end(c);
  EXPECT_EQ(world.events()[1].kind, EventKind::begin);
  EXPECT_EQ(world.events()[1].b, d);
  world.remove(a);
  world.remove(d);
  world.step();
  EXPECT_EQ(world.events().size(), 1u);
  expect_end(d);
}

TEST(Churn, AShrunkWorldGivesTheResultsOfANewOne) {
  Random random(4);
  World shrunk;
  std::vector<BodyId> first = add_crowd(shrunk, {.count = 3000});
  shrunk.step();
  shrunk.remove(first);
  shrunk.step();
  World fresh;
  const std::vector<BodyId> a = add_crowd(shrunk, {.filters = true, .velocities = true});
  const std::vector<BodyId> b = add_crowd(fresh, {.filters = true, .velocities = true});
  for (int i = 0; i < 3; ++i) {
    shrunk.step();
    fresh.step();
    EXPECT_GT(fresh.contacts().size(), 0u);
    EXPECT_EQ(as_bytes(shrunk.pairs()), as_bytes(fresh.pairs()));
    EXPECT_EQ(as_bytes(shrunk.contacts()), as_bytes(fresh.contacts()));
    Random same(5), again(5);
    move_some(shrunk, a, 0.5, same);
    move_some(fresh, b, 0.5, again);
  }
}

TEST(Churn, ManyStepsOfASmallWorldDoNotGrowIt) {
  Random random(6);
  World world;
  std::vector<BodyId> living;
  const auto step = [&] {
    if (living.size() < 20 && random.chance(0.6)) {
      BodyDesc body = any_body(random.below(5));
      if (random.chance(0.1)) body.shape = Halfspace{};
      body.position = random_position(random, 3);
      living.push_back(world.add(body));
    } else if (!living.empty()) {
      world.remove(draw(living, 1, random)[0]);
    }
    world.step();
  };
  for (int i = 0; i < 2000; ++i) step();
  const size_t bytes = world.bytes();
  for (int i = 0; i < 20000; ++i) step();
  EXPECT_LE(world.bytes(), bytes * 3 / 2);  // the greatest number of pairs is still to come
  // Also without a step in between.
  for (int i = 0; i < 20000; ++i) world.remove(world.add(body_at(i)));
  EXPECT_LE(world.bytes(), bytes * 3 / 2);
}

// A body is removed from an index below bodies of one kind that has geometries: what is left in its
// place, numbers of a box or the address of a geometry that is gone, is not read as a geometry.
TEST(Churn, PlacesWithoutABodyHoldNoGeometry) {
  const std::vector<Eigen::Vector3f> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Triangles faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const auto shape_of = [&](ShapeKind kind) -> Shape {
    if (kind == ShapeKind::hull) return hull_of(corners);
    if (kind == ShapeKind::mesh) return mesh_of(corners, faces);
    return compound_of({{Sphere{1}}, {Box{{1, 1, 1}}, {1, 0, 0}}});
  };
  for (const ShapeKind kind : {ShapeKind::hull, ShapeKind::mesh, ShapeKind::compound}) {
    const Shape below[] = {Box{{0.5f, 0.4f, 0.3f}}, Triangle{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}},
                           shape_of(kind)};
    for (const Shape& removed : below) {
      for (const bool stepped : {false, true}) {
        World world;
        const BodyId gone = world.add({.shape = removed});
        world.add({.shape = shape_of(kind)});
        world.add({.shape = shape_of(kind), .position = {0.25, 0, 0}});
        if (stepped) world.step();
        world.remove(gone);
        world.step();
        EXPECT_EQ(world.contacts().size(), 1u);
        std::vector<OverlapHit> hits;
        const float ball[4] = {0.1f, 0.1f, 0.1f, 0.3f};
        world.find_overlaps(sphere_records(ball, 1), hits);
        EXPECT_FALSE(hits.empty());
      }
    }
  }
}

}  // namespace
}  // namespace carom::test
