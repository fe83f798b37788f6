// Inputs that broke other collision systems, or were made to. The oracle computes exact answers
// from the inputs after their rounding to float32.
#include <gtest/gtest.h>

#include "tests/support/float_modes.h"
#include "tests/support/isas.h"
#include "tests/support/oracle.h"
#include "tests/support/run.h"
#include "tests/support/special_floats.h"

namespace carom::test {
namespace {

// Tests the pair on every ISA and in both orders, and checks it against the exact answer; returns
// the result of (A, B).
reference::PairResult checked(const TestPair& pair,
                              PositionType positions = PositionType::float32) {
  for (const TestPair& each : {pair, swapped(pair)}) {
    SCOPED_TRACE(show(each));
    const ExactPair exact(each, positions);
    const reference::PairResult result = reference_result(each, positions);
    const Real size = exact.scale + abs(exact.separation);
    EXPECT_LE(abs(Real(result.separation) - exact.separation), 2e-6 * exact.scale + kEps * size);
    EXPECT_TRUE(result.overlap == (exact.separation <= 0) ||
                abs(exact.separation) < 4 * kEps * size);
    EXPECT_LE(exact.separation - exact.gap_along(test::exact(result.normal)), 1e-5 * size);
    EXPECT_NEAR(result.normal.cast<double>().norm(), 1, 4 * kEps);
    for_each_isa([&] {
      EXPECT_TRUE(same_rows(expected_rows({&each, 1}, positions),
                            run_rows({&each, 1}, call_with(positions)), {&each, 1}));
    });
  }
  return reference_result(pair, positions);
}

// The exact separation, rounded to double.
double exact_separation(const TestPair& pair, PositionType positions = PositionType::float32) {
  return static_cast<double>(ExactPair(pair, positions).separation);
}

TEST(Cases, C01_TouchOf345Triangle) {
  for (const double offset : {0.0, 1e6}) {
    for (const PositionType positions : kPositionTypes) {
      const auto result = checked(
          {sphere(offset, offset, offset, 2.5), sphere(offset + 3, offset + 4, offset, 2.5)},
          positions);
      EXPECT_EQ(result.separation, 0);
      EXPECT_TRUE(result.overlap);
    }
  }
}

TEST(Cases, C02_SumOfRadiiThatRoundsToTheDistance) {
  const TestPair pair{sphere(0, 0, 0, 0.1f), sphere(0.3f, 0, 0, 0.2f)};
  EXPECT_GT(exact_separation(pair), 0);
  EXPECT_FALSE(checked(pair).overlap);
}

TEST(Cases, C05_SquaresBeyondTheRangeOfFloat) {
  const auto result = checked({sphere(1e20, 0, 0, 1), sphere(3e20, 0, 0, 1.9e20)});
  EXPECT_FALSE(result.overlap);
  EXPECT_GT(result.separation, 0.99e19f);
}

TEST(Cases, C07_SquaresBelowTheRangeOfFloat) {
  for (const FloatMode& mode : float_modes()) {
    SCOPED_TRACE(mode.name);
    const auto at = [](double distance) {
      return TestPair{sphere(0, 0, 0, 1e-25), sphere(distance, 0, 0, 1e-25)};
    };
    const TestPair near = at(1.9e-25);
    const TestPair far = at(2.1e-25);
    const ScopedFloatMode scoped(mode);
    const bool near_overlaps = reference_result(near, PositionType::float32).overlap;
    const bool far_overlaps = reference_result(far, PositionType::float32).overlap;
    EXPECT_TRUE(near_overlaps);
    EXPECT_FALSE(far_overlaps);
  }
  checked({sphere(0, 0, 0, 1e-25), sphere(1.9e-25, 0, 0, 1e-25)});
  checked({sphere(0, 0, 0, 1e-25), sphere(2.1e-25, 0, 0, 1e-25)});
}

TEST(Cases, C09_Points) {
  const auto touch = checked({sphere(1, 2, 3, 0), sphere(1, 2, 3, 0)});
  EXPECT_TRUE(touch.overlap);
  EXPECT_EQ(touch.separation, 0);
  const auto apart = checked({sphere(1, 2, 3, 0), sphere(1.0000001f, 2, 3, 0)});
  EXPECT_FALSE(apart.overlap);
  EXPECT_EQ(apart.separation, kEps);
}

TEST(Cases, C11_ConcentricSpheres) {
  const auto result = checked({sphere(1, 2, 3, 2), sphere(1, 2, 3, 2)});
  EXPECT_EQ(result.separation, -4);
  EXPECT_EQ(result.normal, Eigen::Vector3f(1, 0, 0));
  EXPECT_EQ(result.status, Status::degenerate);
}

TEST(Cases, C12_NearlyConcentricSpheres) {
  EXPECT_NEAR(checked({sphere(1, 2, 3, 2), sphere(1.1f, 2, 3, 1.8)}).separation, -3.7, 2e-6 * 1.9);
}

TEST(Cases, C13_SphereSinkingIntoATopFace) {
  float last = -1;
  for (int i = 0; i <= 200; ++i) {
    const double z = -0.01 + (0.01 - 1e-6) * i / 200;
    const auto result =
        checked({sphere(0.1, 0.2, z, 0.005), box({0, 0, -0.255}, {0.5, 0.5, 0.25})});
    EXPECT_NEAR(result.separation, z, 1e-7);
    EXPECT_EQ(result.normal.head<2>(), Eigen::Vector2f(0, 0));
    EXPECT_FLOAT_EQ(result.normal.z(), -1);
    EXPECT_GE(result.separation, last);
    last = result.separation;
  }
}

TEST(Cases, C14_SphereThatTouchesAnEdge) {
  const TestPair pair{sphere(1.79e-10, 0.04, 0.33, 0.06),
                      box({0.05, 0.15, 0.35}, Eigen::Vector3f::Constant(0.05f))};
  EXPECT_NEAR(checked(pair).separation, 0, 1e-6);
}

TEST(Cases, C15_CubesThatOverlapALittle) {
  const Eigen::Vector3f half(1, 1, 1);
  const auto result = checked({box({0, 0, 0}, half), box({0, 0, 1.9}, half)});
  EXPECT_NEAR(result.separation, -0.1, 2e-6);
  EXPECT_EQ(result.normal, Eigen::Vector3f(0, 0, 1));
}

TEST(Cases, C16_DistanceOfUnitCubes) {
  const Eigen::Vector3f half(0.5f, 0.5f, 0.5f);
  const auto result = checked({box({0, 0, 0}, half), box({0, 4, 0}, half)});
  EXPECT_EQ(result.separation, 3);
  EXPECT_EQ(result.normal, Eigen::Vector3f(0, 1, 0));
}

TEST(Cases, C19_FlatBoxInsideATallOne) {
  const auto result = checked({box({-0.675, 0, 0.9115}, {0.307f, 1.5f, 0.185f}),
                               box({-0.692, 0, 0.935}, {0.247f, 0.276f, 0.005f})});
  EXPECT_NEAR(result.separation, -0.1665, 2e-6);
  EXPECT_EQ(result.normal, Eigen::Vector3f(0, 0, 1));
}

TEST(Cases, C21_LeastOverlapAlongZ) {
  const auto result = checked({box({-0.071, -0.772, 0.8}, {0.1f, 0.165f, 0.05f}),
                               box({0.121, -0.787696057, 0.534220442}, {0.226f, 0.135f, 0.3f})});
  EXPECT_NEAR(result.separation, -0.0842204420, 1e-6);
  EXPECT_EQ(result.normal, Eigen::Vector3f(0, 0, -1));
}

TEST(Cases, C22_EqualCubesAFewFloatsFromTouch) {
  for (const float side : {0.01f, 0.25f, 0.5f, 10.0f, 1000.0f}) {
    const Eigen::Vector3f half = Eigen::Vector3f::Constant(side / 2);
    for (int steps = -4; steps <= 4; ++steps) {
      float x = side;
      for (int i = 0; i < std::abs(steps); ++i) {
        x = std::nextafter(x, steps > 0 ? 2 * side : 0.0f);
      }
      const auto result = checked({box({0, 0, 0}, half), box({x, 0, 0}, half)});
      EXPECT_EQ(result.separation, x - side);
      EXPECT_EQ(result.overlap, steps <= 0);
    }
  }
}

TEST(Cases, C28_BoxesThatTouchAwayFromTheOrigin) {
  const Eigen::Vector3f half(1, 1, 1);
  const auto result = checked({box({0, 0, 1.8599132}, half), box({0, 2, 1.8599132}, half)});
  EXPECT_EQ(result.separation, 0);
  EXPECT_TRUE(result.overlap);
}

TEST(Cases, C30_DepthDoesNotDependOnTheSizeOfASlab) {
  for (const float depth : {1e-6f, 1e-4f, 1e-2f, 0.1f}) {
    std::vector<float> separations;
    for (const float s : {1.0f, 10.0f, 25.0f, 50.0f, 100.0f}) {
      const TestPair pair{box({0, 0, 0}, {s, s, 0.25f}),
                          box({0.3, 0.2, 0.35f - depth}, {0.1f, 0.1f, 0.1f})};
      const auto result = checked(pair);
      EXPECT_EQ(result.normal, Eigen::Vector3f(0, 0, 1));
      EXPECT_NEAR(result.separation, exact_separation(pair), kEps);
      separations.push_back(result.separation);
    }
    for (const float separation : separations) EXPECT_EQ(separation, separations[0]);
  }
}

TEST(Cases, C31_FlushBoxes) {
  const Eigen::Vector3f half = Eigen::Vector3f::Constant(0.0355f);
  const TestPair pair{box({0, 0, 0}, half), box({0.071 - 0.000056, 0, 0}, half)};
  const auto result = checked(pair);
  EXPECT_NEAR(result.separation, -0.000056, 2e-8);
  EXPECT_GE(result.separation, exact_separation(pair) - 1e-8);
}

TEST(Cases, C33_EqualDepthAlongEveryAxis) {
  const auto result = checked({box({0, 0, 0}, {10, 10, 10}), box({14, 14, 14}, {5, 5, 5})});
  EXPECT_EQ(result.separation, -1);
  EXPECT_EQ(result.normal, Eigen::Vector3f(1, 0, 0));
}

TEST(Cases, C61_SameContactFarFromTheOrigin) {
  const Eigen::Vector3f half(0.5f, 0.5f, 0.5f);
  const auto at = [&](double x) {
    return TestPair{box({x, 0, 0}, half), box({x + 0.9, 0, 0}, half)};
  };
  const auto here = checked(at(0), PositionType::float64);
  const auto there = checked(at(1e7), PositionType::float64);
  EXPECT_NEAR(here.separation, -0.1, 1e-6);
  EXPECT_NEAR(here.separation, there.separation, 1e-4);
  EXPECT_LE((here.arm_a - there.arm_a).norm(), 1e-4);
  EXPECT_LE((here.arm_b - there.arm_b).norm(), 1e-4);
  EXPECT_EQ(here.normal, there.normal);

  const reference::Box bounds =
      reference::bounds(Aabb::from_half_extents(half), {{1e7 + 0.9, 0, 0}}, PositionType::float64);
  EXPECT_LE(static_cast<double>(bounds.lower.x()), 1e7 + 0.9 - 0.5);
  EXPECT_GE(static_cast<double>(bounds.upper.x()), 1e7 + 0.9 + 0.5);
}

// A sphere centre in the middle of a box leaves along the shortest axis, the first among equal
// ones.
TEST(Cases, CentreOfASphereInTheMiddleOfABox) {
  const auto cube = checked({sphere(5, 6, 7, 0.5), box({5, 6, 7}, {1, 1, 1})});
  EXPECT_EQ(cube.separation, -1.5f);
  EXPECT_EQ(cube.normal, Eigen::Vector3f(1, 0, 0));
  const auto slab = checked({sphere(5, 6, 7, 0.5), box({5, 6, 7}, {3, 2, 1})});
  EXPECT_EQ(slab.separation, -1.5f);
  EXPECT_EQ(slab.normal, Eigen::Vector3f(0, 0, 1));
}

TEST(Cases, PointOnAndBesideAFlatBox) {
  const PlacedShape plate = box({0, 0, 0}, {1, 1, 0});
  EXPECT_EQ(checked({sphere(0.5, 0.5, 0, 0), plate}).separation, 0);
  EXPECT_TRUE(checked({sphere(1, 1, 0, 0), plate}).overlap);
  const auto above = checked({sphere(0.5, 0.5, 1e-45, 0), plate});
  EXPECT_FALSE(above.overlap);
  EXPECT_EQ(above.separation, std::numeric_limits<float>::denorm_min());
  EXPECT_EQ(above.normal, Eigen::Vector3f(0, 0, -1));
}

}  // namespace
}  // namespace carom::test
