// The index of queries: many threads may ask first, and hits do not depend on how it came about.
#include <gtest/gtest.h>

#include <thread>

#include "carom/base/thread_arena.h"
#include "carom/bounds/bounds.h"
#include "queries/body_index.h"
#include "tests/support/cast_checks.h"
#include "tests/support/rounds.h"
#include "tests/world/crowds.h"

namespace carom::test {
namespace {

struct Questions {
  std::vector<PlacedShape> shapes = make_bodies({.count = 24, .side = 9, .composites = false}, 3);
  Sweeps sweeps = make_sweeps(24, 6, false, 4);
  LaidOut queries = LaidOut(shapes, {});
};

// All that a world answers, as text.
std::string answers(const World& world, const Questions& questions,
                    Parallelism parallelism = Parallelism::none) {
  const Collidables queries = questions.queries.view();
  std::string text;
  for (const CastHits which : {CastHits::all, CastHits::closest, CastHits::any}) {
    std::vector<CastHit> hits;
    world.cast(queries, questions.sweeps.view(), hits, {.hits = which, .parallelism = parallelism});
    text += bits_of(hits);
  }
  std::vector<OverlapHit> overlaps;
  world.find_overlaps(queries, overlaps, {.parallelism = parallelism});
  text += as_bytes(std::span<const OverlapHit>(overlaps));
  std::vector<NearestHit> nearest;
  world.find_nearest(queries, 5, nearest, {.parallelism = parallelism});
  for (const NearestHit& hit : nearest) {
    text += std::to_string(hit.query) + " " + std::to_string(hit.body) + " " +
            std::to_string(hit.separation) + "\n";
  }
  std::vector<PointHit> points;
  const std::vector<Eigen::Vector3f> at = {{1, 2, 3}, {3, 3, 3}, {5, 2, 4}};
  world.find_points(at[0].data(), at.size(), sizeof at[0], points);
  for (const PointHit& hit : points) text += std::to_string(hit.body) + "\n";
  return text;
}

CrowdSpec mixed_crowd(size_t count) {
  return {.count = count, .oriented = true, .halfspaces = 2, .filters = true};
}

TEST(WorldQueryThreads, ManyAskFirst) {
  World world;
  const std::vector<BodyId> ids = add_crowd(world, mixed_crowd(400));
  const Questions questions;
  Random random(1);
  for (int step = 0; step < 4; ++step) {
    move_some(world, ids, 0.5, random);
    world.step();
    std::vector<std::string> answer(4);
    {
      std::vector<std::jthread> threads;
      for (std::string& mine : answer) {
        threads.emplace_back([&] { mine = answers(world, questions); });
      }
    }
    for (const std::string& each : answer) EXPECT_EQ(each, answers(world, questions));
    EXPECT_GT(answer[0].size(), 500u);
  }
}

TEST(WorldQueryThreads, WithThreadsOfTheirOwn) {
  World world({.parallelism = Parallelism::arena});
  ThreadArena arena(2);
  const Questions questions;
  arena.run([&] {
    add_crowd(world, mixed_crowd(400));
    world.step();
    world.prepare_queries();
  });
  const std::string expected = answers(world, questions);
  std::vector<std::jthread> threads;
  for (int i = 0; i < 2; ++i) {
    threads.emplace_back([&] {
      ThreadArena own(2);
      own.run([&] { EXPECT_EQ(answers(world, questions, own.parallelism()), expected); });
    });
  }
}

// A world that is queried in every step, and worlds that were built at that step, answer alike.
// Bodies move a little or far, change sides between static and moving, come and go.
TEST(WorldQueryIndex, AnswersDoNotDependOnItsHistory) {
  World world;
  std::vector<BodyId> ids = add_crowd(world, {.count = 300, .oriented = true, .halfspaces = 2});
  const Questions questions;
  Random random(7);
  for (int step = 0; step < static_cast<int>(rounds(40, 14)); ++step) {
    if (step % 7 != 6) move_some(world, ids, step % 10 == 9 ? 1 : 0.3, random);
    if (step % 4 == 0) turn_some(world, ids, 0.2, random);
    for (int i = 0; i < 3 && step % 5 == 1; ++i) {
      const BodyId id = ids[random.below(ids.size())];
      world.set_motion(id, random.chance(0.5) ? Motion::fixed : Motion::dynamic);
      if (step % 5 == 1)
        world.set_position(ids[random.below(ids.size())], random_position(random, 20));
    }
    if (step % 6 == 2 && ids.size() > 200) {
      for (int i = 0; i < 8; ++i) {
        const size_t k = random.below(ids.size());
        world.remove(ids[k]);
        ids.erase(ids.begin() + static_cast<ptrdiff_t>(k));
      }
    }
    if (step % 9 == 4) {
      for (int i = 0; i < 5; ++i) {
        ids.push_back(world.add({.shape = random_shape(ShapeKind::box, random),
                                 .position = random_position(random, 7)}));
      }
    }
    world.step();
    if (step % 11 == 10) continue;  // queries may skip a step
    World fresh;
    // The same bodies at the same indices; bodies between them are removed again.
    uint32_t rows = 0;
    for (const BodyId id : ids) rows = std::max(rows, id.index + 1);
    std::vector<BodyId> placeholders;
    for (uint32_t i = 0; i < rows; ++i) {
      if (!world.is_alive(i)) {
        placeholders.push_back(fresh.add({}));
        continue;
      }
      const BodyId id = world.id_of(i);
      fresh.add({.shape = world.shape(id),
                 .position = world.position(id),
                 .orientation = world.orientation(id),
                 .motion = world.motion(id)});
    }
    fresh.remove(placeholders);
    fresh.step();
    ASSERT_EQ(answers(world, questions), answers(fresh, questions)) << "step " << step;
  }
}

// Bodies of an index: how it follows them.
class Followed {
 public:
  explicit Followed(size_t count) : motion_(count, Motion::dynamic) {
    Random random(1);
    for (size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d at = random_position(random, 20);
      for (int axis = 0; axis < 3; ++axis) records_.push_back(static_cast<float>(at[axis]));
      records_.push_back(0.2f);
      if (i % 2 == 0) motion_[i] = Motion::fixed;
    }
  }

  float& x(size_t i) { return records_[4 * i]; }
  Motion& motion(size_t i) { return motion_[i]; }
  void update() {
    const Collidables bodies = sphere_records(records_.data(), motion_.size());
    std::array<std::vector<float>, 6> columns;
    for (std::vector<float>& column : columns) column.resize(motion_.size());
    const auto three = [&](size_t i) -> std::array<float*, 3> {
      return {columns[i].data(), columns[i + 1].data(), columns[i + 2].data()};
    };
    const auto read = [&](size_t i) -> std::array<const float*, 3> {
      return {columns[i].data(), columns[i + 1].data(), columns[i + 2].data()};
    };
    (void)compute_bounds(bodies, {three(0), three(3)}, Parallelism::none);
    index_.update(bodies, {read(0), read(3), motion_.size()}, motion_.data(), {},
                  Parallelism::none);
  }
  // Builds and refits: of static bodies, then of the others.
  std::array<size_t, 4> counts() const {
    const auto& fixed = index_.counts(0);
    const auto& moving = index_.counts(1);
    return {fixed.builds, fixed.refits, moving.builds, moving.refits};
  }

 private:
  std::vector<float> records_;
  std::vector<Motion> motion_;
  BodyIndex index_;
};

// A static body loses its place, comes back as another kind of motion, and must be found once.
TEST(WorldQueryIndex, ABodyThatComesBackIsFoundOnce) {
  World world;
  const auto add = [&](double x, Motion motion) {
    return world.add({.shape = Sphere{0.5f}, .position = {x, 0, 0}, .motion = motion});
  };
  const float query[4] = {0, 0, 0, 1}, way[3] = {0, 0, 1};
  const auto expect_hits = [&](size_t count) {
    std::vector<OverlapHit> overlaps;
    world.find_overlaps(sphere_records(query, 1), overlaps);
    EXPECT_EQ(overlaps.size(), count);
    std::vector<CastHit> hits;
    world.cast(sphere_records(query, 1), {.displacement = way}, hits, {.hits = CastHits::all});
    EXPECT_EQ(hits.size(), count);
  };
  const BodyId body = add(0, Motion::fixed), other = add(10, Motion::fixed);
  add(20, Motion::dynamic);
  world.step();
  expect_hits(1);
  world.set_position(body, {NAN, 0, 0});
  world.step();
  expect_hits(0);
  add(30, Motion::dynamic);
  world.step();
  expect_hits(0);
  world.set_motion(body, Motion::dynamic);
  world.set_position(body, {0, 0, 0});
  world.set_position(other, {10.01, 0, 0});
  world.step();
  expect_hits(1);
}

// All bodies have one kind of motion, so that runs of them are looked at together. Bodies are put
// where none was, one in each run in turn, and must be found there and nowhere else.
TEST(WorldQueryIndex, BodiesOfOneMotionAreFollowed) {
  for (const Motion motion : {Motion::dynamic, Motion::fixed}) {
    World world;
    std::vector<BodyId> ids;
    for (double x = 0; x < 400; ++x) {
      ids.push_back(world.add({.shape = Sphere{0.25f}, .position = {x, 0, 0}, .motion = motion}));
    }
    const auto bodies_at = [&](size_t i, float y) {
      const float query[4] = {static_cast<float>(i), y, 0, 0.25f};
      std::vector<OverlapHit> hits;
      world.find_overlaps(sphere_records(query, 1), hits);
      return hits.size();
    };
    world.step();
    for (const size_t i : {3u, 100u, 399u, 63u, 64u}) {
      ASSERT_EQ(bodies_at(i, 0), 1u);
      world.set_position(ids[i], {static_cast<double>(i), 2, 0});
      world.step();
      EXPECT_EQ(bodies_at(i, 2), 1u) << i;
      EXPECT_EQ(bodies_at(i, 0), 0u) << i;
    }
  }
}

TEST(BodyIndex, RefitsAPartInWhichBodiesMoved) {
  using Counts = std::array<size_t, 4>;
  Followed bodies(2000);
  bodies.update();
  EXPECT_EQ(bodies.counts(), (Counts{1, 0, 1, 0}));
  bodies.update();  // nothing has moved
  EXPECT_EQ(bodies.counts(), (Counts{1, 0, 1, 0}));
  for (size_t i = 1; i < 2000; i += 2) bodies.x(i) += 0.01f;
  bodies.update();
  EXPECT_EQ(bodies.counts(), (Counts{1, 0, 1, 1}));
  bodies.x(0) += 1;
  bodies.update();
  EXPECT_EQ(bodies.counts(), (Counts{1, 1, 1, 1}));
  for (size_t i = 1; i < 2000; i += 2) bodies.x(i) += i % 4 == 1 ? 15.0f : -15.0f;
  bodies.update();  // worn
  EXPECT_EQ(bodies.counts(), (Counts{1, 1, 2, 2}));
  bodies.x(3) = NAN;
  bodies.update();  // leaves its place empty
  EXPECT_EQ(bodies.counts(), (Counts{1, 1, 2, 3}));
  bodies.x(3) = 4;
  bodies.update();  // the place is still there
  EXPECT_EQ(bodies.counts(), (Counts{1, 1, 2, 4}));
  bodies.motion(4) = Motion::dynamic;
  bodies.update();
  EXPECT_EQ(bodies.counts(), (Counts{2, 1, 3, 4}));
}

}  // namespace
}  // namespace carom::test
