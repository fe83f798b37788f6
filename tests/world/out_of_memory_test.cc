// A step, or a query, that runs out of memory leaves a world that works.
#include <gtest/gtest.h>

#include <array>
#include <new>
#include <string>
#include <vector>

#include "tests/world/counted_malloc.h"
#include "tests/world/crowds.h"

#if defined(CAROM_TEST_COUNTS_MALLOC)

namespace carom::test {
namespace {

struct Trouble {
  bool came;    // there were as many allocations
  bool failed;  // and `work` failed; sorting, for one, does without
};

// Runs `work` with the n-th of its allocations failing.
template <class Work>
Trouble make_trouble(size_t n, const Work& work) {
  const size_t failing = allocations() + n;
  fail_allocation(failing);
  Trouble trouble{};
  try {
    work();
  } catch (const std::bad_alloc&) {
    trouble.failed = true;
  }
  trouble.came = allocations() >= failing;
  fail_allocation(0);
  return trouble;
}

constexpr CrowdSpec kTroubled{
    .count = 200, .side = 5, .oriented = true, .halfspaces = 2, .velocities = true};

struct Troubled {
  explicit Troubled(const WorldSettings& settings)
      : world(settings), ids(add_crowd(world, kTroubled)) {
    for (size_t i = 10; i + 1 < ids.size(); i += 9) world.exclude(ids[i], ids[i + 1]);
  }
  void move() {
    move_some(world, ids, 0.7, random);
    turn_some(world, ids, 0.3, random);
  }

  World world;
  std::vector<BodyId> ids;
  Random random{7};
};

// Lets the n-th allocation of a step fail. False if it has fewer.
bool fails_and_begins_anew(const WorldSettings& settings, bool is_first_step, size_t n) {
  SCOPED_TRACE(std::to_string(n));
  Troubled troubled(settings), fresh(settings);
  if (!is_first_step) troubled.world.step();
  troubled.move();
  fresh.move();
  const Trouble trouble = make_trouble(n, [&] { troubled.world.step(); });
  if (!trouble.came || !trouble.failed) return trouble.came;
  EXPECT_TRUE(troubled.world.pairs().empty());
  EXPECT_TRUE(troubled.world.contacts().empty());
  for (int step = 0; step < 2; ++step) {
    troubled.world.step();
    fresh.world.step();
    EXPECT_TRUE(results(troubled.world) == results(fresh.world));
    troubled.move();
    fresh.move();
  }
  return true;
}

TEST(OutOfMemory, TheNextStepIsThatOfANewWorld) {
  const WorldSettings all[] = {
      {},
      {.detail = Detail::pairs, .pair_changes = true},
      {.detail = Detail::manifold,
       .margin = 0.1f,
       .dop_bounds = DopKind::k14,
       .pair_changes = true},
      {.detail = Detail::regions, .contact_distance = 0.1f, .identities = true}};
  for (const WorldSettings& settings : all) {
    for (const bool is_first_step : {true, false}) {
      size_t n = 1;
      while (fails_and_begins_anew(settings, is_first_step, n)) ++n;
      EXPECT_GT(n, is_first_step ? 30u : 5u);
    }
  }
}

// One large ball.
std::vector<OverlapHit> hits_of_a_ball(const World& world) {
  constexpr std::array<float, 4> kBall = {0, 0, 0, 4};
  Collidables ball;
  ball.count = 1;
  ball.uniform_kind = ShapeKind::sphere;
  ball.position.data = kBall.data();
  ball.position.stride = sizeof(kBall);
  ball.position.radius_layout = RadiusLayout::fourth;
  std::vector<OverlapHit> hits;
  world.find_overlaps(ball, hits, QueryOptions{});
  return hits;
}

TEST(OutOfMemory, TheNextQueryHasAllHits) {
  size_t n = 1;
  for (;; ++n) {
    SCOPED_TRACE(std::to_string(n));
    Troubled troubled({}), fresh({});
    troubled.world.step();
    fresh.world.step();
    if (!make_trouble(n, [&] { troubled.world.prepare_queries(); }).came) break;
    const std::vector<OverlapHit> expected = hits_of_a_ball(fresh.world);
    EXPECT_GT(expected.size(), 50u);
    ASSERT_TRUE(hits_of_a_ball(troubled.world) == expected);
  }
  EXPECT_GT(n, 5u);
}

// A pose that was written and not listed would never be seen again.
TEST(OutOfMemory, APoseThatCannotBeListedStays) {
  World world;
  world.add({.shape = Sphere{1}});
  const BodyId ball = world.add({.shape = Sphere{1}, .position = {1.5, 0, 0}});
  const BodyId box = world.add({.shape = Box{{1, 1, 1}}, .position = {9, 0, 0}});
  world.step();
  EXPECT_TRUE(make_trouble(1, [&] { world.set_position(ball, {10, 0, 0}); }).failed);
  EXPECT_EQ(world.position(ball).x(), 1.5);
  EXPECT_TRUE(make_trouble(1, [&] { world.set_orientation(box, {0, 1, 0, 0}); }).failed);
  EXPECT_EQ(world.orientation(box).w(), 1);
  world.step();
  EXPECT_EQ(world.contacts().size(), 1u);
  world.set_position(ball, {10, 0, 0});
  world.step();
  ASSERT_EQ(world.contacts().size(), 1u);
  EXPECT_EQ(world.contacts()[0].a, ball.index);
  EXPECT_EQ(world.contacts()[0].b, box.index);
}

}  // namespace
}  // namespace carom::test

#endif  // defined(CAROM_TEST_COUNTS_MALLOC)
