// Corners of hulls that hang over an edge of the face below, in nearly parallel position: face axes
// and edge axes give the same separation up to rounding, but different contact locations.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/checked_everywhere.h"
#include "tests/support/hulls.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using Eigen::AngleAxisf;
using Eigen::Quaternionf;
using Eigen::Vector3d;
using Eigen::Vector3f;
using oracle::Random;

PlacedShape cube_at(const Vector3d& position, const Eigen::Vector4f& turn) {
  return placed_hull(cube_corners(), position, Quaternionf(turn));  // x, y, z, w
}

// The witness point was 9e-4 and 0.018 beside the surface.
TEST(HullBorders, CornersBesideAFaceTouchItsEdge) {
  const PlacedShape a = cube_at({-0x1.a72174p-2, 0x1p-2, 0x1.e66666p+0},
                                {0x1.4104a4p-16f, 0x1.8380dp-15f, 0x1.87de2ap-2f, 0x1.d906bcp-1f});
  for (const PlacedShape& b : {oriented_box({0, 0, 0}, {1, 1, 1}), box({0, 0, 0}, {1, 1, 1}),
                               placed_hull(cube_corners())}) {
    const auto result = checked_everywhere({a, b});
    EXPECT_NEAR(result.arm_b.x(), 1, 4e-6);
  }
  const PlacedShape further =
      cube_at({0x1.7689f4p-2, 0x1.a31faep-1, 0x1.dc84dcp+0},
              {0x1.22716p-15f, -0x1.4f570ep-15f, 0x1.2eb1acp-1f, 0x1.9cf0eap-1f});
  const auto result = checked_everywhere({further, placed_hull(cube_corners())});
  EXPECT_NEAR(result.arm_b.x(), 1, 4e-6);
}

// A cube over an edge of another cube: one corner is beyond the edge by up to a tenth.
PlacedShape overhanging(Random& random) {
  const auto logarithmic = [&](double least, double most) {
    return least * std::pow(most / least, random.uniform(0, 1));
  };
  const auto about_z = static_cast<float>(random.uniform(0.1, 1.4));
  const auto tilt = static_cast<float>(logarithmic(2e-5, 3e-3));
  const Vector3f axis = random.direction().cast<float>().cwiseProduct(Vector3f(1, 1, 0));
  const Quaternionf turn =
      Quaternionf(AngleAxisf(tilt, axis.normalized())) * AngleAxisf(about_z, Vector3f::UnitZ());
  double reach = -2;  // x of the lowest corner
  double lowest = 2;
  for (const Vector3f& corner : cube_corners()) {
    const Vector3f p = turn * corner;
    if (p.z() < lowest) {
      lowest = p.z();
      reach = p.x();
    }
  }
  const double beyond = logarithmic(1e-5, 0.1);
  return placed_hull(cube_corners(), {1 - reach + beyond, random.uniform(-0.5, 0.5), 1.9}, turn);
}

TEST(HullBorders, WitnessesLieOnBothSurfaces) {
  Random random(31);
  Triangle large{.corners = {Vector3f(1, -9, 1), Vector3f(1, 9, 1), Vector3f(-9, 0, 1)}};
  for (uint32_t i = 0; i < rounds(150); ++i) {
    const PlacedShape a = overhanging(random);
    checked_everywhere({a, placed_hull(cube_corners())});
    checked_everywhere({a, oriented_box({0, 0, 0}, {1, 1, 1})});
    checked_everywhere({a, {large, {0, 0, 0}}});
  }
}

}  // namespace
}  // namespace carom::test
