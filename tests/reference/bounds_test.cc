// Bounds of the reference against rational arithmetic.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>

#include "tests/support/families.h"
#include "tests/support/float_modes.h"
#include "tests/support/show.h"
#include "tests/support/special_floats.h"

namespace carom::test {
namespace {

using Rational = boost::multiprecision::cpp_rational;

// `bound` is the largest float that is not above `exact`.
void expect_tight_below(float bound, const Rational& exact) {
  EXPECT_LE(Rational(bound), exact) << hex(bound);
  const float next = std::nextafter(bound, kInfinity);
  EXPECT_TRUE(!std::isfinite(next) || Rational(next) > exact) << hex(bound);
}

void expect_tight(const PlacedShape& body, PositionType positions) {
  const ShownIfFailed shown([&] { return show(body) + ", " + name(positions); });
  const reference::Box box = reference::bounds(body.shape, body.pose(), positions);
  const RoundedBox shape = rounded_box(body.shape);
  const Eigen::Vector3d position = stored(body.position, positions);
  for (int i = 0; i < 3; ++i) {
    const Rational p(position[i]);
    if (std::isfinite(box.lower[i])) {
      expect_tight_below(box.lower[i], p + Rational(shape.lower[i]) - Rational(shape.radius));
    }
    if (std::isfinite(box.upper[i])) {
      expect_tight_below(-box.upper[i], -(p + Rational(shape.upper[i]) + Rational(shape.radius)));
    }
  }
}

TEST(ReferenceBounds, AreTheSmallestThatContainTheShape) {
  for (const Family& family : families()) {
    for (const Sides sides : {Sides::sphere_aabb, Sides::aabb_sphere}) {
      for (const PositionType positions : kPositionTypes) {
        for (const TestPair& pair : make_pairs(family, sides, positions, 100)) {
          expect_tight(pair.a, positions);
          expect_tight(pair.b, positions);
          ASSERT_FALSE(HasFailure()) << family.name;
        }
      }
    }
  }
}

RC_GTEST_PROP(ReferenceBounds, AreTightForSpheresOfAnyBits, (uint32_t radius, uint64_t x)) {
  const PlacedShape body{Sphere{std::fabs(std::bit_cast<float>(radius))},
                         {std::bit_cast<double>(x), 0, std::bit_cast<float>(radius)}};
  for (const PositionType positions : kPositionTypes) {
    if (reference::is_valid(body.shape, body.pose(), positions)) expect_tight(body, positions);
  }
  RC_ASSERT(!testing::Test::HasFailure());
}

TEST(ReferenceBounds, ExactWhereCornersAreFloats) {
  const reference::Box box =
      reference::bounds(Sphere{0.5f}, {{1, -2, 1024}}, PositionType::float32);
  EXPECT_EQ(box.lower, Eigen::Vector3f(0.5f, -2.5f, 1023.5f));
  EXPECT_EQ(box.upper, Eigen::Vector3f(1.5f, -1.5f, 1024.5f));
}

TEST(ReferenceBounds, OverflowOutwards) {
  const float largest = std::numeric_limits<float>::max();
  const reference::Box box =
      reference::bounds(Sphere{largest}, {{largest, -largest, 0}}, PositionType::float32);
  EXPECT_EQ(box.lower, Eigen::Vector3f(0, -kInfinity, -largest));
  EXPECT_EQ(box.upper, Eigen::Vector3f(kInfinity, 0, largest));
  const reference::Box far =
      reference::bounds(Sphere{1}, {{1e300, -1e300, 0}}, PositionType::float64);
  EXPECT_EQ(far.lower, Eigen::Vector3f(largest, -kInfinity, -1));
  EXPECT_EQ(far.upper, Eigen::Vector3f(kInfinity, -largest, 1));
}

TEST(ReferenceBounds, InvalidBodiesAreEmpty) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const PlacedShape bodies[] = {sphere(0, 0, 0, -1),        sphere(0, 0, 0, -1e-45f),
                                sphere(0, 0, 0, kInfinity), sphere(0, 0, 0, nan),
                                sphere(nan, 0, 0, 1),       sphere(0, kInfinity, 0, 1),
                                box({0, 0, 0}, {1, -1, 1}), box({0, 0, 0}, {1, 1, nan})};
  for (const FloatMode& mode : float_modes()) {
    for (const PlacedShape& body : bodies) {
      const ScopedFloatMode scoped(mode);
      EXPECT_FALSE(reference::is_valid(body.shape, body.pose(), PositionType::float32));
      const reference::Box box = reference::bounds(body.shape, body.pose(), PositionType::float64);
      EXPECT_EQ(box.lower, Eigen::Vector3f::Constant(kInfinity));
      EXPECT_EQ(box.upper, Eigen::Vector3f::Constant(-kInfinity));
      EXPECT_FALSE(reference::overlap(box, box));
    }
  }
  // The position overflows float32, but not float64.
  EXPECT_FALSE(reference::is_valid(Sphere{1}, {{1e39, 0, 0}}, PositionType::float32));
  EXPECT_TRUE(reference::is_valid(Sphere{1}, {{1e39, 0, 0}}, PositionType::float64));
  EXPECT_TRUE(reference::is_valid(Sphere{-0.0f}, {{0, 0, 0}}, PositionType::float32));
}

}  // namespace
}  // namespace carom::test
