// Shapes that pass each other by a thousand times the tolerance of the search, where B - A is a
// sliver: rounding turns its normal, so that a plain search takes them for touching.
#include <gtest/gtest.h>

#include "impacts/approach.h"
#include "impacts/turning_approach.h"
#include "narrowphase/doubles/furthest_scalar.h"
#include "tests/support/impacts.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using Eigen::Vector3d;

constexpr double kTolerance = 0x1p-38;

// A direction, and two that are perpendicular to it and to each other.
struct Axes {
  Vector3d along, across, up;

  explicit Axes(Random& random) : along(random.direction()) {
    across = along.unitOrthogonal();
    up = along.cross(across);
  }
};

// A triangle that is 2^-26 wide, and zero some 1e-9 below it.
void draw_sliver(Random& random, const Axes& axes, Core& core) {
  const double height = std::exp2(random.uniform(-34, -28));
  const double width = std::exp2(random.uniform(-28, -24));
  const auto corner = [&](double along, double across) -> Vector3d {
    return axes.along * along + axes.across * (across * width) + axes.up * height;
  };
  core.resize(3);
  core.set(0, scalar::core_vector(corner(-random.uniform(0.5, 1), random.uniform(0.3, 1))));
  core.set(1, scalar::core_vector(corner(random.uniform(0.5, 1), random.uniform(0.3, 1))));
  core.set(2, scalar::core_vector(corner(random.uniform(-0.1, 0.1), -random.uniform(0.5, 1))));
  core.pad();
  core.middle = core.point(static_cast<size_t>(random.below(3)));
}

TEST(Slivers, AreNotTouchedByWhatIsBeside) {
  Random random(1);
  size_t near = 0;
  for (uint32_t i = 0; i < rounds(20000); ++i) {
    const Axes axes(random);
    Core zero, sliver;
    zero.resize(1);
    zero.set(0, {0, 0, 0});
    zero.pad();
    draw_sliver(random, axes, sliver);
    const scalar::PlainNearest plain({{sliver.point(1), sliver.point(2)}, 0b011}, sliver.point(0));
    near += plain.is_unclear && std::sqrt(plain.squared) <= kTolerance;

    scalar::MovingPair pair;
    pair.from = Vector3d::Zero();
    pair.way = axes.across * 0.5;
    pair.furthest = &scalar::furthest_point;
    pair.a = scalar::moving_core(zero, Vector3d::Zero(), Vector3d::Zero(), true);
    pair.b = scalar::moving_core(sliver, Vector3d::Zero(), Vector3d::Zero(), true);
    const scalar::Approach<scalar::PlainNearest> straight(pair, 0, kTolerance);
    EXPECT_FALSE(straight.is_over() && straight.time() <= 1) << i;
    pair.b = scalar::moving_core(sliver, Vector3d::Zero(), axes.up * 0.5, true);
    const scalar::TurningApproach turning(pair, 0, kTolerance);
    EXPECT_FALSE(turning.is_over() && turning.time() <= 1) << i;
  }
  EXPECT_GT(near, rounds(20000) / 2000);
}

// Two rods that cross at an angle of 2^-26, some 1e-9 apart. Both are turned by the same, so that
// rounding moves their ends.
MovedPair draw_rods(Random& random, bool turns) {
  const double width = std::exp2(random.uniform(-28, -24));
  const auto rod = [&](double least_across, double most_across) {
    const auto end = [&](double side) -> Eigen::Vector3f {
      const double across = random.uniform(least_across, most_across) * width;
      return Vector3d(side * random.uniform(0.5, 1), side * across, 0).cast<float>();
    };
    return Hull{*make_hull(std::vector{end(1), end(-1)}, {})};
  };
  MovedPair pair;
  pair.bodies.a.shape = rod(0, 0);
  pair.bodies.b.shape = rod(0.5, 1);
  const Eigen::AngleAxisf turn(2, random.direction().cast<float>());
  pair.bodies.a.orientation = pair.bodies.b.orientation = turn;
  const Eigen::Quaterniond turned = pair.bodies.a.orientation.cast<double>().normalized();
  const double height = std::exp2(random.uniform(-34, -28));
  pair.bodies.b.position = turned * Vector3d(random.uniform(-0.2, 0.2), 0, height);
  pair.sweep_b.displacement = (turned * Vector3d(0, 0.5, 0)).cast<float>();
  if (turns) pair.sweep_b.rotation = (turned * Vector3d(0, 0, 0.5)).cast<float>();
  return pair;
}

TEST(Slivers, OfRodsHaveTheTimesOfTheReferenceOnEveryIsa) {
  for (const bool turns : {false, true}) {
    Random random(turns ? 3 : 2);
    std::vector<MovedPair> pairs;
    while (pairs.size() < rounds(30000, 10000)) pairs.push_back(draw_rods(random, turns));
    const ImpactCall call = impact_call(PositionType::float64);
    const auto expected = expected_impacts(pairs, call);
    for_each_isa([&] { EXPECT_TRUE(same_impacts(expected, run_impacts(pairs, call), pairs)); });
  }
}

}  // namespace
}  // namespace carom::test
