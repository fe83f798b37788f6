// Where cylinders and cones touch: standing, lying, leaning, face to face.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/isas.h"
#include "tests/support/run.h"

namespace carom::test {
namespace {

using Eigen::Vector3f;

constexpr float kQuarter = std::numbers::pi_v<float> / 2;

Eigen::Quaternionf about_x(float angle) {
  return Eigen::Quaternionf(Eigen::AngleAxisf(angle, Vector3f::UnitX()));
}

// B on A, which is a floor whose top is z = 0, or a shape about zero: the reference, which every
// ISA equals in both orders. Points are relative to A.
reference::PairResult touching(const Shape& below, const Shape& above, const Eigen::Vector3d& at,
                               const Eigen::Quaternionf& turn = Eigen::Quaternionf::Identity()) {
  constexpr PositionType kPositions = PositionType::float64;
  const TestPair pair = {{below, {0, 0, 0}}, {above, at, turn}};
  for (const TestPair& each : {pair, swapped(pair)}) {
    Call call = call_with(kPositions);
    call.detail = Detail::manifold;
    for_each_isa([&] {
      EXPECT_TRUE(same_rows(expected_rows({&each, 1}, kPositions, Detail::manifold),
                            run_rows({&each, 1}, call), {&each, 1}));
    });
  }
  return reference_result(pair, kPositions);
}

// The least distance between two points of a manifold.
float least_spread(const reference::PairResult& result) {
  float least = std::numeric_limits<float>::infinity();
  for (size_t i = 0; i < result.manifold_count; ++i) {
    for (size_t k = 0; k < i; ++k) {
      const auto &p = result.manifold.point[i], &q = result.manifold.point[k];
      least = std::min(least, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
    }
  }
  return least;
}

const Shape kFloor = Aabb{{-5, -5, -1}, {5, 5, 0}};

TEST(RoundManifold, AStandingCylinderHasFourPointsOnItsRim) {
  const auto result = touching(kFloor, Cylinder{1, 2}, {0.5, -0.25, 1.99});
  EXPECT_NEAR(result.separation, -0.01, 1e-6);
  EXPECT_NEAR(result.normal.z(), 1, 1e-6);
  ASSERT_EQ(result.manifold_count, 4);
  EXPECT_GT(least_spread(result), 1.2);
  for (size_t i = 0; i < 4; ++i) {
    const auto& p = result.manifold.point[i];
    EXPECT_NEAR(std::hypot(p[0] - 0.5f, p[1] + 0.25f), 1, 1e-5) << i;
  }
}

TEST(RoundManifold, ALyingCylinderHasTwoPointsAtTheEndsOfItsSide) {
  const auto result = touching(kFloor, Cylinder{1, 2}, {0, 0, 0.99}, about_x(kQuarter));
  EXPECT_NEAR(result.separation, -0.01, 1e-6);
  ASSERT_EQ(result.manifold_count, 2);
  EXPECT_NEAR(least_spread(result), 4, 1e-4);
}

TEST(RoundManifold, ALeaningCylinderHasOnePointOfItsRim) {
  const float angle = 0.5f;
  const double height = 2 * std::cos(angle) + 1 * std::sin(angle);  // of the middle over the rim
  const auto result = touching(kFloor, Cylinder{1, 2}, {0, 0, height - 0.01}, about_x(angle));
  EXPECT_NEAR(result.separation, -0.01, 1e-6);
  EXPECT_EQ(result.manifold_count, 1);
}

TEST(RoundManifold, TwoDiscsFaceToFaceHaveFourPointsWhereTheyOverlap) {
  for (const double aside : {0.0, 0.75}) {
    const auto result = touching(Cylinder{1, 2}, Cylinder{1, 2}, {aside, 0, 3.99});
    EXPECT_NEAR(result.separation, -0.01, 1e-6);
    ASSERT_EQ(result.manifold_count, 4);
    EXPECT_GT(least_spread(result), aside == 0 ? 1.2 : 0.5);
    for (size_t i = 0; i < 4; ++i) {
      const auto& p = result.manifold.point[i];
      EXPECT_LE(std::hypot(p[0], p[1]), 1 + 1e-5) << i;
      EXPECT_LE(std::hypot(p[0] - static_cast<float>(aside), p[1]), 1 + 1e-5) << i;
    }
  }
}

TEST(RoundManifold, AConeOnItsBaseHasFourPointsOnItsRim) {
  const auto result = touching(kFloor, Cone{1, 2}, {0, 0, 1.99});
  EXPECT_NEAR(result.separation, -0.01, 1e-6);
  ASSERT_EQ(result.manifold_count, 4);
  EXPECT_GT(least_spread(result), 1.2);
}

TEST(RoundManifold, AConeOnItsSideHasTwoPoints) {
  // The side leads up from the rim by atan(1 / 4) of the axis.
  const float slope = std::atan(0.25f);
  const auto result =
      touching(kFloor, Cone{1, 2}, {0, 0, 2 * std::sin(slope) - 0.01}, about_x(kQuarter + slope));
  EXPECT_NEAR(result.separation, -0.01, 1e-5);
  EXPECT_EQ(result.manifold_count, 2);
  EXPECT_NEAR(least_spread(result), std::sqrt(17.0f), 1e-3);
}

}  // namespace
}  // namespace carom::test
