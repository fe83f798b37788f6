// Distances from surfaces of round shapes, beside points of the surface all around.
#include "oracle/round_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "oracle/random.h"

namespace carom::oracle {
namespace {

using Vec = Vec3<long double>;

double distance(const Shape& shape, const Vec& p) {
  return static_cast<double>(*round_surface_distance(shape, p));
}

TEST(RoundSurface, KnowsRoundShapesAlone) {
  EXPECT_FALSE(round_surface_distance(Sphere{1}, Vec{0, 0, 0}));
  EXPECT_FALSE(round_surface_distance(Box{{1, 1, 1}}, Vec{0, 0, 0}));
}

TEST(RoundSurface, CylinderAndCone) {
  const Cylinder cylinder{2, 3};
  EXPECT_DOUBLE_EQ(distance(cylinder, {0, 0, 0}), 2);
  EXPECT_DOUBLE_EQ(distance(cylinder, {0, 0, 2.5}), 0.5);
  EXPECT_DOUBLE_EQ(distance(cylinder, {3, 4, 7}), 5);
  EXPECT_DOUBLE_EQ(distance(cylinder, {0, -2, 1}), 0);
  const Cone cone{3, 2};  // its side is 5 long
  EXPECT_DOUBLE_EQ(distance(cone, {0, 0, 5}), 3);
  EXPECT_DOUBLE_EQ(distance(cone, {0, 0, -2.25}), 0.25);
  EXPECT_DOUBLE_EQ(distance(cone, {0, 0, -1}), 1);
  EXPECT_DOUBLE_EQ(distance(cone, {0, 1.5 + 4 * 0.1, 0.3}), 0.5);
  EXPECT_DOUBLE_EQ(distance(Cylinder{2, 0}, {1, 0, 0.5}), 0.5);
}

TEST(RoundSurface, EllipsoidsWithoutRoundness) {
  EXPECT_DOUBLE_EQ(distance(Ellipsoid{{2, 2, 2}}, {0, 0, 0}), 2);
  EXPECT_DOUBLE_EQ(distance(Ellipsoid{{2, 2, 2}}, {0, 3, 4}), 3);
  EXPECT_DOUBLE_EQ(distance(Ellipsoid{{3, 2, 1}}, {0, 0, 0}), 1);
  EXPECT_DOUBLE_EQ(distance(Ellipsoid{{3, 2, 0}}, {1, 1, 0.5}), 0.5);
  EXPECT_DOUBLE_EQ(distance(Ellipsoid{{3, 2, 0}}, {5, 0, 0}), 2);
  EXPECT_DOUBLE_EQ(distance(Ellipsoid{{0, 0, 0}}, {3, 4, 0}), 5);
}

// Found by RoundAccuracy: a search that began at one metre ended too early for the smallest.
TEST(RoundSurface, EllipsoidsOfAllSizes) {
  const Vec p{0.3L, 1.2L, -0.4L};
  const double expected = distance(Ellipsoid{{0.5f, 0.75f, 0.25f}}, p);
  for (const int power : {-130, -100, -20, 20, 60}) {
    const float size = std::ldexp(1.0f, power);
    const Ellipsoid scaled{{0.5f * size, 0.75f * size, 0.25f * size}};
    EXPECT_NEAR(distance(scaled, p * size) / size, expected, 1e-15) << power;
  }
}

// No point of a fine grid is nearer, and some are hardly further.
TEST(RoundSurface, NoPointOfAnEllipsoidIsNearer) {
  constexpr int kSteps = 240;
  Random random(7);
  for (int round = 0; round < 40; ++round) {
    Ellipsoid e;
    for (float& axis : e.semi_axes) axis = static_cast<float>(random.uniform(0.2, 2));
    if (round % 5 == 0) e.semi_axes.y() = e.semi_axes.x();
    Vec p{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)};
    if (round % 3 == 0) p.z = 0;
    if (round % 4 == 0) p.x = 0;
    const Eigen::Vector3d at(double(p.x), double(p.y), double(p.z));
    double nearest = INFINITY;
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; j < 2 * kSteps; ++j) {
        const double up = std::numbers::pi * (double(i) / kSteps - 0.5);
        const double around = std::numbers::pi * j / kSteps;
        const Eigen::Vector3d unit(std::cos(up) * std::cos(around), std::cos(up) * std::sin(around),
                                   std::sin(up));
        nearest = std::min(nearest, (e.semi_axes.cast<double>().cwiseProduct(unit) - at).norm());
      }
    }
    const double found = distance(e, p);
    EXPECT_LE(found, nearest + 1e-12) << round;
    EXPECT_GE(found, nearest - 0.02) << round;
  }
}

}  // namespace
}  // namespace carom::oracle
