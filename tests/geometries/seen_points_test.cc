// Hulls are turned within the rounding of float32, and to the same bits on every ISA.
#include "geometries/seen_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "oracle/random.h"
#include "tests/support/isas.h"

namespace carom::test {
namespace {

using oracle::Random;

// A cloud of points about as large as `size`, at `from_origin` from the origin of its frame.
std::vector<Eigen::Vector3f> cloud(size_t count, double size, double from_origin, Random& random) {
  const Eigen::Vector3d middle = from_origin * random.direction();
  std::vector<Eigen::Vector3f> points;
  for (size_t i = 0; i < count; ++i) {
    const double arm = size * random.uniform(0, 1);
    points.push_back((middle + arm * random.direction()).cast<float>());
  }
  return points;
}

FrameChange random_change(double offset, Random& random) {
  const Eigen::Vector3d axis = random.direction(), way = offset * random.direction();
  const double angle = random.uniform(-3, 3);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, axis).matrix();
  FrameChange change;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<size_t>(i);
    change.turn[k] = {turn(i, 0), turn(i, 1), turn(i, 2)};
    change.offset[k] = way[i];
  }
  return change;
}

void expect_same(const SeenPoints& seen, const PartBox& box, const SeenPoints& other,
                 const PartBox& other_box) {
  EXPECT_EQ(seen.size, other.size);
  EXPECT_EQ(box.middle, other_box.middle);
  EXPECT_EQ(box.half, other_box.half);
  for (size_t axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(seen.middle[axis], other.middle[axis]);
    for (size_t i = 0; i < seen.count; ++i) {
      EXPECT_EQ(seen.column[axis][i], other.column[axis][i]);
    }
  }
}

TEST(SeenPoints, HoldAHullWithItsBox) {
  Random random(1);
  for (const double size : {1e-30, 1e-3, 1.0, 1e6, 1e30}) {
    for (const double from_origin : {0.0, 3.0, 1000.0}) {
      for (const size_t count : {1, 3, 4, 5, 15, 16, 17, 63, 64}) {
        SCOPED_TRACE(testing::Message() << size << ' ' << from_origin << ' ' << count);
        const auto points = cloud(count, size, from_origin * size, random);
        const auto hull = *make_hull(points, {});
        const FrameChange change = random_change(1e4 * size, random);
        SeenPoints seen;
        const PartBox box = see_hull(*hull, change, seen);
        for_each_isa([&] {
          SeenPoints other;
          const PartBox other_box = see_hull(*hull, change, other);
          expect_same(seen, box, other, other_box);
        });
        ASSERT_EQ(seen.count, count);
        const double slack = 0x1p-20 * size, of_middle = 0x1p-45 * (from_origin + 1e4) * size;
        Double3 lower = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, upper = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
        for (size_t i = 0; i < count; ++i) {
          const Eigen::Vector3d p = points[i].cast<double>();
          const Double3 at = plus(turned(change.turn, {p.x(), p.y(), p.z()}), change.offset);
          for (size_t axis = 0; axis < 3; ++axis) {
            const double x = seen.column[axis][i] * seen.up + seen.middle[axis];
            EXPECT_NEAR(x, at[axis], slack + of_middle + 0x1p-22 * from_origin * size);
            EXPECT_LE(std::fabs(seen.column[axis][i]), seen.size);
            lower[axis] = std::min(lower[axis], at[axis]);
            upper[axis] = std::max(upper[axis], at[axis]);
          }
        }
        for (size_t axis = 0; axis < 3; ++axis) {
          EXPECT_NEAR(box.middle[axis] - box.half[axis], lower[axis],
                      slack + of_middle + 0x1p-22 * from_origin * size);
          EXPECT_NEAR(box.middle[axis] + box.half[axis], upper[axis],
                      slack + of_middle + 0x1p-22 * from_origin * size);
        }
      }
    }
  }
}

// The box has a meaning at places that float32 does not have.
TEST(SeenPoints, HaveABoxBeyondFloats) {
  const auto hull = *make_hull(std::vector<Eigen::Vector3f>{{1, 2, 3}, {-1, 0, 5}}, {});
  const FrameChange change = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {1e200, -1e300, 0}};
  for_each_isa([&] {
    SeenPoints seen;
    const PartBox box = see_hull(*hull, change, seen);
    EXPECT_EQ(box.middle, (Double3{1e200, -1e300, 4}));
    EXPECT_EQ(box.half, (Double3{1, 1, 1}));
  });
}

}  // namespace
}  // namespace carom::test
