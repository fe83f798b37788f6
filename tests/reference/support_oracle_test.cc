// The oracle by support functions, against closed forms and against the oracle by features.
#include "oracle/support_oracle.h"

#include <gtest/gtest.h>

#include "oracle/convex_families.h"
#include "oracle/convex_oracle.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using oracle::ConvexShape;
using oracle::Random;
using oracle::SupportShape;
using Vec = oracle::Vec3<long double>;

SupportShape point_at(const Vec& p, long double radius = 0) {
  return {[p](const Vec&) { return p; }, radius};
}

SupportShape ball_of(long double radius) {
  return {[radius](const Vec& way) { return oracle::normalized(way) * radius; }, 0};
}

SupportShape ellipsoid_of(const Vec& semi_axes) {
  return {[e = semi_axes](const Vec& way) {
            const Vec scaled{e.x * way.x, e.y * way.y, e.z * way.z};
            const Vec unit = oracle::normalized(scaled);
            return Vec{e.x * unit.x, e.y * unit.y, e.z * unit.z};
          },
          0};
}

// By its points; the shape must outlive it.
SupportShape points_of(const ConvexShape<>& shape) {
  return {[&shape](const Vec& way) {
            Vec best = shape.points.front();
            for (const Vec& p : shape.points) {
              if (dot(way, p) > dot(way, best)) best = p;
            }
            return best;
          },
          shape.radius};
}

void expect_bounds(const SupportShape& a, const SupportShape& b, long double expected,
                   long double tolerance) {
  const auto found = separation_by_supports(a, b, tolerance);
  EXPECT_LE(found.low, expected + 1e-17L);
  EXPECT_GE(found.high, expected - 1e-17L);
  EXPECT_LE(found.high - found.low, tolerance * (1 + 1e-9L));
  EXPECT_NEAR(static_cast<double>(length(found.normal)), 1, 1e-12);
}

TEST(SupportOracle, ClosedForms) {
  const Vec zero{0, 0, 0};
  expect_bounds(point_at(zero, 1), point_at({3, 4, 0}, 2), 2, 1e-10L);
  expect_bounds(point_at(zero, 1), point_at(zero, 2), -3, 1e-10L);
  expect_bounds(ball_of(1), point_at({2, 1, 2}), 2, 1e-10L);
  expect_bounds(ball_of(1), point_at({0.2L, 0.1L, 0.2L}), -0.7L, 1e-10L);
  // The nearest surface of an ellipsoid is across its shortest axis, in the middle.
  expect_bounds(ellipsoid_of({3, 2, 1}), point_at(zero), -1, 1e-10L);
  expect_bounds(ellipsoid_of({3, 2, 1}), point_at({0, 5, 0}), 3, 1e-10L);
  // Along the normal at (1, 1, 1) / sqrt(3), seen from the unit ball: (1/3, 1/2, 1) there.
  const Vec on = Vec{3, 2, 1} * (1 / std::sqrt(3.0L));
  const Vec out = oracle::normalized(Vec{1.0L / 3, 0.5L, 1});
  expect_bounds(ellipsoid_of({3, 2, 1}), point_at(on + out * 0.75L), 0.75L, 1e-10L);
  expect_bounds(ellipsoid_of({3, 2, 1}), point_at(on - out * 0.125L), -0.125L, 1e-10L);
  expect_bounds(ball_of(1), ball_of(2), -3, 0.01L);  // all directions are as good
}

TEST(SupportOracle, AgreesWithTheOracleByFeatures) {
  constexpr ShapeKind kKinds[] = {ShapeKind::sphere, ShapeKind::capsule, ShapeKind::box,
                                  ShapeKind::triangle, ShapeKind::hull};
  Random random(50);
  oracle::ConvexRandom shapes({.aspect = 4}, random);
  size_t overlaps = 0;
  const uint32_t count = rounds(60, 8);
  for (uint32_t round = 0; round < count; ++round) {
    const auto shape = [&] { return shapes.shape(kKinds[random.below(std::size(kKinds))], 1); };
    const Pose at_zero{{0, 0, 0}, shapes.orientation()};
    const Pose beside{random.direction() * random.uniform(0, 2), shapes.orientation()};
    const ConvexShape<> a(shape(), at_zero), b(shape(), beside);
    const auto expected = oracle::separation_with_normal(a, b);
    const auto found = separation_by_supports(points_of(a), points_of(b), 1e-7L);
    overlaps += expected.value < 0;
    EXPECT_LE(found.low, expected.value + 1e-15L);
    EXPECT_GE(found.high, expected.value - 1e-15L);
    EXPECT_LE(found.high - found.low, 1e-7L);
    EXPECT_NEAR(static_cast<double>(oracle::gap_along(a, b, found.normal) - found.low), 0, 1e-15);
  }
  EXPECT_GT(overlaps, count / 5);
  EXPECT_LT(overlaps, count * 4 / 5);
}

}  // namespace
}  // namespace carom::test
