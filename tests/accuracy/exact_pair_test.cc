// ExactPair, the judge of carom accuracy: what it takes for the exact answer.
#include "accuracy/pairs/exact_pair.h"

#include <gtest/gtest.h>

#include <cmath>

namespace carom::accuracy {
namespace {

ConvexPair spheres(double distance, float radius_a, float radius_b) {
  ConvexPair pair;
  pair.shape_a = Sphere{radius_a};
  pair.shape_b = Sphere{radius_b};
  pair.pose_b.position.x() = distance;
  return pair;
}

TEST(ExactPair, DecidesWhatLongDoubleCannot) {
  EXPECT_EQ(ExactPair(spheres(3, 1, 2)).truth(), Truth::overlap);
  EXPECT_EQ(ExactPair(spheres(std::nextafter(3, 4), 1, 2)).truth(), Truth::apart);
  EXPECT_EQ(ExactPair(spheres(std::nextafter(3, 2), 1, 2)).truth(), Truth::overlap);
  // The surfaces are 3e-20 apart, which long double cannot resolve beside 3.
  ConvexPair grazing = spheres(3, 1, 2);
  grazing.pose_b.position.y() = 4e-10;
  EXPECT_EQ(ExactPair(grazing).truth(), Truth::apart);
  // The surfaces are 1e-647 apart.
  grazing.pose_b.position.y() = 5e-324;
  EXPECT_EQ(ExactPair(grazing).truth(), Truth::apart);
}

// ExactPair trusts long double for separations beyond 1e-17 of the extent: this tests that margin.
TEST(ExactPair, LongDoubleIsCloseEnoughTo100Digits) {
  for (const NamedKinds& kinds : kAllKinds) {
    if (kinds.kinds.a == ShapeKind::dop || kinds.kinds.b == ShapeKind::dop) continue;
    for (const ConvexFamily& family : oracle::convex_families()) {
      for (const ConvexPair& pair :
           oracle::make_convex_pairs(family, kinds.kinds, PositionType::float64, 1)) {
        EXPECT_LE(rounding_share(pair), 0.2e-17) << kinds.name << ", " << family.name;
      }
    }
  }
}

}  // namespace
}  // namespace carom::accuracy
