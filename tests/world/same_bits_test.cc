// One history of a world under many circumstances: the same bytes after every step.
#include <gtest/gtest.h>

#include "carom/base/thread_arena.h"
#include "tests/support/float_modes.h"
#include "tests/support/isas.h"
#include "tests/support/own_jobs.h"
#include "tests/world/crowds.h"

namespace carom::test {
namespace {

constexpr CrowdSpec kCrowd{.count = 1500, .side = 11, .filters = true, .velocities = true};
constexpr CrowdSpec kOriented{.count = 1500,
                              .side = 11,
                              .oriented = true,
                              .halfspaces = 3,
                              .filters = true,
                              .velocities = true};

// Bodies are moved, added, removed and become invalid.
std::vector<Results> history(const WorldSettings& settings, const CrowdSpec& spec = kCrowd,
                             const Eigen::Vector3d& shift = Eigen::Vector3d::Zero()) {
  World world(settings);
  std::vector<BodyDesc> crowd = make_crowd(spec);
  for (BodyDesc& body : crowd) body.position += shift;
  std::vector<BodyId> ids;
  world.add(crowd, ids);
  Random random(3);
  std::vector<Results> all;
  for (int frame = 0; frame < 8; ++frame) {
    world.step();
    all.push_back(results(world));
    if (frame == 2) continue;  // a still step
    move_some(world, ids, frame == 5 ? 1 : 0.3, random);
    if (spec.oriented) turn_some(world, ids, 0.3, random);
    for (int i = 0; i < 5; ++i) {
      const size_t which = random.below(ids.size());
      world.remove(ids[which]);
      ids[which] = world.add(crowd[random.below(crowd.size())]);
    }
    world.set_shape(ids[random.below(ids.size())], Sphere{frame % 2 ? -1.0f : 0.5f});
  }
  return all;
}

void expect_equal(const std::vector<Results>& got, const std::vector<Results>& expected) {
  ASSERT_EQ(got.size(), expected.size());
  for (size_t i = 0; i < got.size(); ++i) {
    EXPECT_EQ(got[i].pairs == expected[i].pairs, true) << "pairs of frame " << i;
    EXPECT_EQ(got[i].overlaps == expected[i].overlaps, true) << "overlaps of frame " << i;
    EXPECT_EQ(got[i].contacts == expected[i].contacts, true) << "contacts of frame " << i;
    EXPECT_EQ(got[i].manifolds == expected[i].manifolds, true) << "manifolds of frame " << i;
    EXPECT_EQ(got[i].events == expected[i].events, true) << "events of frame " << i;
    EXPECT_EQ(got[i].quarantined == expected[i].quarantined, true) << "frame " << i;
    EXPECT_EQ(got[i].impacts == expected[i].impacts, true) << "impacts of frame " << i;
    EXPECT_EQ(got[i].speculative == expected[i].speculative, true) << "frame " << i;
  }
}

TEST(SameBits, OnEveryIsa) {
  for (const PositionType positions : {PositionType::float32, PositionType::float64}) {
    const WorldSettings settings{.positions = positions};
    const std::vector<Results> expected = history(settings);
    EXPECT_GT(expected[0].contacts.size(), 100 * sizeof(Contact));
    for_each_isa([&] { expect_equal(history(settings), expected); });
  }
}

TEST(SameBits, OfAllKindsOnEveryIsa) {
  for (const PositionType positions : {PositionType::float32, PositionType::float64}) {
    const WorldSettings settings{.positions = positions, .detail = Detail::manifold};
    const std::vector<Results> expected = history(settings, kOriented);
    EXPECT_GT(expected[0].manifolds.size(), 100 * sizeof(ManifoldPoints));
    for_each_isa([&] { expect_equal(history(settings, kOriented), expected); });
  }
}

TEST(SameBits, OfAllKindsWithEveryBroadphaseAndOnThreads) {
  WorldSettings settings{.detail = Detail::manifold};
  const std::vector<Results> expected = history(settings, kOriented);
  ThreadArena arena(4);
  for (const BroadphaseMethod method :
       {BroadphaseMethod::brute, BroadphaseMethod::sweep, BroadphaseMethod::grid}) {
    settings.broadphase = method;
    arena.run([&] { expect_equal(history(settings, kOriented), expected); });
  }
}

TEST(SameBits, WithEveryBroadphase) {
  const std::vector<Results> expected = history({});
  for (const BroadphaseMethod method :
       {BroadphaseMethod::brute, BroadphaseMethod::sweep, BroadphaseMethod::grid}) {
    expect_equal(history({.broadphase = method}), expected);
  }
}

TEST(SameBits, OnAnyNumberOfThreads) {
  CrowdSpec many = kCrowd;
  many.count = 12000;
  many.side = 22;
  for (const float margin : {0.0f, 0.1f}) {
    const WorldSettings alone{.parallelism = Parallelism::none, .margin = margin};
    const std::vector<Results> expected = history(alone, many);
    for (const int threads : {1, 2, 4}) {
      ThreadArena arena(threads);
      const WorldSettings settings{.parallelism = arena.parallelism(), .margin = margin};
      arena.run([&] { expect_equal(history(settings, many), expected); });
    }
  }
}

// So many that loops of a nanosecond a body are shared, too.
TEST(SameBits, OfManySpheresOnAnyNumberOfThreads) {
  const CrowdSpec many{.count = 40000, .side = 30, .boxes = false, .velocities = true};
  const auto three_steps = [&](Parallelism parallelism) {
    World world({.parallelism = parallelism});
    const std::vector<BodyId> ids = add_crowd(world, many);
    Random random(5);
    std::vector<Results> steps;
    for (const double share : {1.0, 0.3, 0.01}) {
      world.step();
      steps.push_back(results(world));
      move_some(world, ids, share, random);
    }
    return steps;
  };
  const std::vector<Results> expected = three_steps(Parallelism::none);
  EXPECT_GT(expected[0].contacts.size(), 30000 * sizeof(Contact));
  for (const int threads : {2, 4}) {
    ThreadArena arena(threads);
    arena.run([&] { expect_equal(three_steps(arena.parallelism()), expected); });
  }
}

TEST(SameBits, WithAnySchedulerOfTheCaller) {
  CrowdSpec many = kOriented;
  many.count = 6000;
  many.side = 23;
  many.looks_ahead = true;
  const WorldSettings settings{.detail = Detail::manifold, .margin = 0.05f};
  WorldSettings alone = settings;
  alone.parallelism = Parallelism::none;
  const std::vector<Results> expected = history(alone, many);
  BackwardJobs backward;
  ThreadJobs two(2), five(5);
  for (Jobs* const jobs : std::vector<Jobs*>{&backward, &two, &five}) {
    const JobsScope scope(*jobs);
    expect_equal(history(settings, many), expected);
  }
  EXPECT_GT(backward.tasks(), 300u);
  EXPECT_EQ(backward.most_inside(), 1);
  EXPECT_EQ(two.runs(), backward.runs());
  EXPECT_EQ(five.runs(), backward.runs());
}

TEST(SameBits, InAnyFloatModeOfTheCaller) {
  for (const PositionType positions : {PositionType::float32, PositionType::float64}) {
    const WorldSettings settings{.positions = positions};
    const std::vector<Results> expected = history(settings);
    for (const FloatMode& mode : float_modes()) {
      SCOPED_TRACE(mode.name);
      // Other rounding modes would change the history itself.
      if ((mode.mxcsr & 0x6000) != 0) continue;
      const ScopedFloatMode scoped(mode);
      expect_equal(history(settings), expected);
    }
  }
}

// Subnormal sizes and positions, where flush-to-zero would change every result.
TEST(SameBits, OfATinyWorldInAnyFloatMode) {
  const auto contacts = [](const FloatMode& mode) {
    World world;
    for (int i = 0; i < 200; ++i) {
      world.add({.shape = Sphere{static_cast<float>(i % 7) * 0x1p-149f},
                 .position = {(i * 37 % 200) * 0x1p-147, (i % 3) * 0x1p-148, 0}});
    }
    const ScopedFloatMode scoped(mode);
    world.step();
    return results(world);
  };
  const Results expected = contacts(kDefaultMode);
  EXPECT_GT(expected.contacts.size(), 50 * sizeof(Contact));
  for (const FloatMode& mode : float_modes()) {
    EXPECT_TRUE(contacts(mode) == expected) << mode.name;
  }
}

TEST(SameBits, TheCallersFloatModeIsItsOwnAgain) {
#if defined(__SSE2__)
  for (const FloatMode& mode : float_modes()) {
    World world;
    add_crowd(world, {});
    const ScopedFloatMode scoped(mode);
    const unsigned before = _mm_getcsr();
    world.step();
    EXPECT_EQ(_mm_getcsr(), before) << mode.name;
  }
#endif
}

// Contacts are relative to the bodies, so a float64 world may lie anywhere. Its float32 bounds are
// coarser far out, so more pairs are tested.
TEST(SameBits, OfAllKindsInAnyFloatModeOfTheCaller) {
  const WorldSettings settings{.detail = Detail::manifold};
  const std::vector<Results> expected = history(settings, kOriented);
  for (const FloatMode& mode : float_modes()) {
    SCOPED_TRACE(mode.name);
    if ((mode.mxcsr & 0x6000) != 0) continue;
    const ScopedFloatMode scoped(mode);
    expect_equal(history(settings, kOriented), expected);
  }
}

TEST(SameBits, FarFromTheOriginInFloat64) {
  const WorldSettings settings{.positions = PositionType::float64};
  const std::vector<Results> near = history(settings);
  for (const Eigen::Vector3d& shift :
       {Eigen::Vector3d(0x1p30, 0x1p30, 0x1p30), Eigen::Vector3d(-0x1p30, 0, 0x1p24)}) {
    const std::vector<Results> far = history(settings, kCrowd, shift);
    for (size_t i = 0; i < near.size(); ++i) {
      EXPECT_EQ(far[i].contacts == near[i].contacts, true) << "contacts of frame " << i;
      EXPECT_EQ(far[i].events == near[i].events, true) << "events of frame " << i;
      EXPECT_GE(far[i].pairs.size(), near[i].pairs.size());
    }
  }
}

TEST(SameBits, OfTwoWorldsThatGotThereDifferently) {
  World warm, cold;
  const CrowdSpec spec{.filters = true};
  const std::vector<BodyId> ids = add_crowd(warm, spec);
  Random random(2);
  for (int frame = 0; frame < 20; ++frame) {
    warm.step();
    move_some(warm, ids, 0.5, random);
  }
  std::vector<BodyDesc> bodies = make_crowd(spec);
  std::vector<BodyId> same;
  for (size_t i = 0; i < ids.size(); ++i) bodies[i].position = warm.position(ids[i]);
  cold.add(bodies, same);
  warm.step();
  cold.step();
  EXPECT_TRUE(as_bytes(warm.pairs()) == as_bytes(cold.pairs()));
  EXPECT_TRUE(as_bytes(warm.overlaps()) == as_bytes(cold.overlaps()));
  EXPECT_TRUE(as_bytes(warm.contacts()) == as_bytes(cold.contacts()));
}

}  // namespace
}  // namespace carom::test
