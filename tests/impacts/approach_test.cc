// How far cores get that do not rotate, against a slow search. Their distance is a convex function
// of time: its least value is found by thirds, the first time of a distance by halving.
#include "impacts/approach.h"

#include <gtest/gtest.h>

#include <vector>

#include "narrowphase/doubles/furthest_scalar.h"
#include "oracle/random.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using Eigen::Vector3d;
using oracle::Random;

constexpr double kTolerance = 0x1p-34;

struct MovingCores {
  Core a, b;
  scalar::MovingPair pair;

  double distance(double t) const {
    const CoreVector at = scalar::core_vector(pair.from + pair.way * t);
    Core moved = b;
    for (size_t i = 0; i < b.size(); ++i) moved.set(i, b.point(i) + at);
    moved.pad();
    moved.middle = b.middle + at;
    const CoreVector way = nearest_way(a, moved, &scalar::furthest_point).way;
    return std::sqrt(dot(way, way)) - pair.radii;
  }

  // A time from 0 to 1 at which they are about nearest.
  double nearest_time() const {
    double low = 0, high = 1;
    for (int i = 0; i < 80; ++i) {
      const double third = (high - low) / 3;
      const bool falls = distance(low + third) > distance(high - third);
      (falls ? low : high) = falls ? low + third : high - third;
    }
    return (low + high) / 2;
  }
  // The first time at which they are no more than `most` apart; they are at `end`.
  double first_time(double most, double end) const {
    double low = 0, high = end;
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (distance(middle) > most ? low : high) = middle;
    }
    return high;
  }
};

// Small integers give cores with parallel faces, that touch and pass at no distance.
Vector3d random_vector(Random& random, bool is_integer, double size) {
  const auto number = [&] {
    return is_integer ? std::round(random.uniform(-size, size)) : random.uniform(-size, size);
  };
  return {number(), number(), number()};
}

void draw(Random& random, bool is_integer, Core& core) {
  const size_t count = 1 + random.below(20);
  core.resize(count);
  for (size_t i = 0; i < count; ++i) {
    core.set(i, scalar::core_vector(random_vector(random, is_integer, 1.4)));
  }
  core.pad();
  core.middle = core.point(0);
}

void draw(Random& random, MovingCores& cores) {
  const bool is_integer = random.chance(0.5);
  draw(random, is_integer, cores.a);
  draw(random, is_integer, cores.b);
  cores.pair.from = random_vector(random, is_integer, 6);
  // Half of them head for the other one.
  cores.pair.way = random.chance(0.5) ? Vector3d(cores.pair.from * -random.uniform(0.5, 2))
                                      : random_vector(random, is_integer, 12);
  cores.pair.radii = random.chance(0.5) ? 0 : random.uniform(0, 0.5);
  cores.pair.a = scalar::moving_core(cores.a, Vector3d::Zero(), Vector3d::Zero(), true);
  cores.pair.b = scalar::moving_core(cores.b, Vector3d::Zero(), Vector3d::Zero(), true);
  cores.pair.furthest = &scalar::furthest_point;
}

template <class Nearest>
class StraightApproach : public testing::Test {};
using Searches = testing::Types<scalar::PlainNearest, scalar::CarefulNearest>;
TYPED_TEST_SUITE(StraightApproach, Searches);

TYPED_TEST(StraightApproach, IsAsSlowAsTheSlowSearchSays) {
  using Nearest = TypeParam;
  constexpr double kRounding = 1e-13;
  Random random(1);
  size_t pairs = 0, met = 0, missed = 0, unsure = 0;
  for (uint32_t i = 0; i < rounds(4000); ++i) {
    MovingCores cores;
    draw(random, cores);
    if (cores.distance(0) <= kTolerance) continue;
    ++pairs;
    const scalar::Approach<Nearest> approach(cores.pair, 0, kTolerance);
    if (approach.time() == scalar::kNever) {
      ++missed;
      ASSERT_TRUE(approach.is_over());
      ASSERT_GT(cores.distance(cores.nearest_time()), -kRounding) << i;
      continue;
    }
    ASSERT_GE(approach.time(), 0) << i;
    ASSERT_LE(approach.time(), 1) << i;
    const double reached = cores.distance(approach.time());
    if (!approach.is_over()) {
      ++unsure;
      ASSERT_GT(reached, -kRounding) << i;
      continue;
    }
    ++met;
    ASSERT_LE(reached, kTolerance + kRounding) << i;
    // Not late: they come no nearer before.
    ASSERT_LE(approach.time(), cores.first_time(0, approach.time()) + kRounding) << i;
    const double earlier = cores.distance(approach.time() * (1 - 1e-3));
    ASSERT_GT(earlier, -kRounding) << i;
  }
  EXPECT_GT(met, pairs / 5);
  EXPECT_GT(missed, pairs / 5);
  EXPECT_LT(unsure, pairs / 50);
}

TYPED_TEST(StraightApproach, EndsAtTheLatestTimeThatCounts) {
  using Nearest = TypeParam;
  MovingCores cores;
  for (Core* core : {&cores.a, &cores.b}) {
    core->resize(1);
    core->set(0, {0, 0, 0});
    core->pad();
  }
  cores.pair.a = scalar::moving_core(cores.a, Vector3d::Zero(), Vector3d::Zero(), true);
  cores.pair.b = scalar::moving_core(cores.b, Vector3d::Zero(), Vector3d::Zero(), true);
  cores.pair.from = {4, 0, 0};
  cores.pair.way = {-4, 0, 0};
  cores.pair.radii = 1;
  cores.pair.furthest = &scalar::furthest_point;
  EXPECT_NEAR(scalar::Approach<Nearest>(cores.pair, 0, kTolerance).time(), 0.75, 1e-9);
  cores.pair.latest = 0.7;
  EXPECT_EQ(scalar::Approach<Nearest>(cores.pair, 0, kTolerance).time(), scalar::kNever);
}

}  // namespace
}  // namespace carom::test
