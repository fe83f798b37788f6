// How far hulls and k-DOPs reach: in lanes as point by point, to the bit.
#include "bounds/point_reach.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "oracle/random.h"
#include "tests/support/isas.h"

namespace carom::test {
namespace {

Intervals plain_reach(const std::array<Double3, 3>& axes, const std::vector<Double3>& points) {
  Intervals result;
  result.fill({HUGE_VAL, -HUGE_VAL});
  for (const Double3& point : points) {
    for (size_t axis = 0; axis < 3; ++axis) {
      const double x = dot(axes[axis], point);
      result[axis] = {std::min(result[axis].lower, x), std::max(result[axis].upper, x)};
    }
  }
  return result;
}

std::vector<Double3> points_of(const HullGeometry& hull) {
  std::vector<Double3> points;
  for (const Eigen::Vector3f& p : hull.points()) points.push_back({p.x(), p.y(), p.z()});
  return points;
}

std::vector<Double3> points_of(const DopPolytope& polytope) {
  std::vector<Double3> points;
  for (size_t i = 0; i < polytope.point_count(); ++i) points.push_back(polytope.point(i));
  return points;
}

std::array<Double3, 3> random_axes(oracle::Random& random) {
  return rotation_of({static_cast<float>(random.uniform(-1, 1)), 0.2f,
                      static_cast<float>(random.uniform(-1, 1)), 0.4f});
}

template <class Shape>
void expect_plain_reach(const std::array<Double3, 3>& axes, const Shape& shape) {
  const Intervals expected = plain_reach(axes, points_of(shape));
  for_each_isa([&] {
    const Intervals reach = point_reach(axes, shape);
    for (size_t axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(reach[axis].lower, expected[axis].lower);
      EXPECT_EQ(reach[axis].upper, expected[axis].upper);
    }
  });
}

TEST(PointReach, OfHullsIsThatOfEachPoint) {
  oracle::Random random(51);
  for (const size_t count : {1, 2, 3, 4, 7, 8, 9, 15, 16, 17, 31, 32, 33, 100}) {
    for (int round = 0; round < 20; ++round) {
      const double size = random.log_uniform(1e-30, 1e30);
      std::vector<Eigen::Vector3f> points;
      for (size_t i = 0; i < count; ++i) {
        points.push_back((random.direction() * size * random.uniform(0, 1)).cast<float>());
      }
      const auto hull = *make_hull(points, {});
      expect_plain_reach(random_axes(random), *hull);
    }
  }
}

// The corners of few points are from one to some forty.
TEST(PointReach, OfDopsIsThatOfEachCorner) {
  oracle::Random random(52);
  std::set<size_t> counts;
  for (const DopKind kind : {DopKind::k6, DopKind::k14, DopKind::k18, DopKind::k26}) {
    for (const size_t count : {1, 2, 3, 4, 6, 20}) {
      for (int round = 0; round < 10; ++round) {
        std::vector<Eigen::Vector3f> points(count);
        for (auto& p : points) p = random.direction().cast<float>();
        const DopPolytope polytope{DopSlabs(Dop::of_points(points, kind))};
        counts.insert(polytope.point_count());
        expect_plain_reach(random_axes(random), polytope);
      }
    }
  }
  EXPECT_GE(counts.size(), 20u);
  EXPECT_GE(*counts.rbegin(), 40u);
}

// The least of +0 and -0 may be either.
TEST(PointReach, HasPositiveZeros) {
  const auto hull = *make_hull(std::vector<Eigen::Vector3f>{{-0.0f, 0, -0.0f}, {0, -0.0f, 0}}, {});
  const std::array<Double3, 3> axes = {{{1, 0, 0}, {-1, -1, -1}, {0, 0, 1}}};
  for_each_isa([&] {
    for (const Interval& ends : point_reach(axes, *hull)) {
      EXPECT_FALSE(std::signbit(ends.lower) || std::signbit(ends.upper));
    }
  });
}

}  // namespace
}  // namespace carom::test
