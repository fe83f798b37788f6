// Sines and rotations of motions against long double.
#include "impacts/turning.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace carom::test {
namespace {

using Eigen::Vector3d;
using scalar::SinCos;

void expect_sin_cos(double angle, double most_wrong) {
  const SinCos found = scalar::sin_cos(angle);
  EXPECT_NEAR(found.sin, std::sin(static_cast<long double>(angle)), most_wrong) << angle;
  EXPECT_NEAR(found.cos, std::cos(static_cast<long double>(angle)), most_wrong) << angle;
}

TEST(Turning, SinesOfAnglesOfManyTurns) {
  std::mt19937_64 random(1);
  for (const double most : {1e-3, 1.0, 3.0, 6.3, 6.5, 100.0, 6000.0}) {
    std::uniform_real_distribution<double> angle(-most, most);
    for (int i = 0; i < 20000; ++i) expect_sin_cos(angle(random), 0x1p-48 + 0x1p-53 * most);
  }
  for (const double angle :
       {0.0, 6.283185307179586, 6.283185307179587, -6.283185307179586, 5e-324}) {
    expect_sin_cos(angle, 0x1p-48);
  }
}

TEST(Turning, SinesOfSmallAnglesKeepTheirDigits) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> exponent(-300, -1);
  for (int i = 0; i < 20000; ++i) {
    const double angle = std::exp2(exponent(random));
    EXPECT_NEAR(scalar::sin_cos(angle).sin / std::sin(angle), 1, 0x1p-48) << angle;
  }
}

TEST(Turning, TurnsAreUnitQuaternionsAboutTheAxis) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20000; ++i) {
    const Vector3d rotation = Vector3d(normal(random), normal(random), normal(random)) * 3;
    const auto turn = scalar::turn_by(rotation, 0.25);
    EXPECT_NEAR(turn.v.squaredNorm() + turn.w * turn.w, 1, 0x1p-46);
    const double angle = rotation.norm() * 0.25;
    EXPECT_NEAR((turn.v - rotation.normalized() * std::sin(angle / 2)).norm(), 0, 0x1p-46);
  }
  const auto still = scalar::turn_by(Vector3d::Zero(), 0.5);
  EXPECT_EQ(still.v, Vector3d::Zero());
  EXPECT_EQ(still.w, 1);
}

}  // namespace
}  // namespace carom::test
