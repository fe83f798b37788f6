// How far hulls reach: in lanes as point by point, to the bit.
#include "bounds/hull_reach.h"

#include <gtest/gtest.h>

#include <cmath>

#include "oracle/random.h"
#include "tests/support/isas.h"

namespace carom::test {
namespace {

Intervals plain_reach(const std::array<Double3, 3>& axes, const HullGeometry& hull) {
  Intervals result;
  result.fill({HUGE_VAL, -HUGE_VAL});
  for (const Eigen::Vector3f& point : hull.points()) {
    for (size_t axis = 0; axis < 3; ++axis) {
      const double x = dot(axes[axis], {point.x(), point.y(), point.z()});
      result[axis] = {std::min(result[axis].lower, x), std::max(result[axis].upper, x)};
    }
  }
  return result;
}

TEST(HullReach, IsThatOfEachPoint) {
  oracle::Random random(51);
  for (const size_t count : {1, 2, 3, 4, 7, 8, 9, 15, 16, 17, 31, 32, 33, 100}) {
    for (int round = 0; round < 20; ++round) {
      const double size = random.log_uniform(1e-30, 1e30);
      std::vector<Eigen::Vector3f> points;
      for (size_t i = 0; i < count; ++i) {
        points.push_back((random.direction() * size * random.uniform(0, 1)).cast<float>());
      }
      const auto hull = *make_hull(points, {});
      const std::array<Double3, 3> axes =
          rotation_of({static_cast<float>(random.uniform(-1, 1)), 0.2f,
                       static_cast<float>(random.uniform(-1, 1)), 0.4f});
      const Intervals expected = plain_reach(axes, *hull);
      for_each_isa([&] {
        const Intervals reach = hull_reach(axes, *hull);
        for (size_t axis = 0; axis < 3; ++axis) {
          EXPECT_EQ(reach[axis].lower, expected[axis].lower);
          EXPECT_EQ(reach[axis].upper, expected[axis].upper);
        }
      });
    }
  }
}

// The least of +0 and -0 may be either.
TEST(HullReach, HasPositiveZeros) {
  const auto hull = *make_hull(std::vector<Eigen::Vector3f>{{-0.0f, 0, -0.0f}, {0, -0.0f, 0}}, {});
  const std::array<Double3, 3> axes = {{{1, 0, 0}, {-1, -1, -1}, {0, 0, 1}}};
  for_each_isa([&] {
    for (const Interval& ends : hull_reach(axes, *hull)) {
      EXPECT_FALSE(std::signbit(ends.lower) || std::signbit(ends.upper));
    }
  });
}

}  // namespace
}  // namespace carom::test
