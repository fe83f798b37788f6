// The nearest point of a triangle that is nearly a line, against 50 digits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "narrowphase/doubles/gjk.h"
#include "oracle/digits.h"
#include "oracle/random.h"
#include "oracle/vec3.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using oracle::Random;
using Many = oracle::Digits<50>;
using Point = oracle::Vec3<Many>;

Point exact(const CoreVector& v) { return {Many(v.x), Many(v.y), Many(v.z)}; }

Many distance_of_segment(const Point& a, const Point& b) {
  const Point side = b - a;
  const Many squared = dot(side, side);
  Many along = squared > 0 ? Many(-dot(a, side) / squared) : Many(0);
  along = std::clamp(along, Many(0), Many(1));
  return length(a + side * along);
}

Many distance_of_triangle(const Point& a, const Point& b, const Point& c) {
  const Point n = cross(b - a, c - a);
  const bool is_over =
      dot(n, cross(a, b)) > 0 && dot(n, cross(b, c)) > 0 && dot(n, cross(c, a)) > 0;
  if (is_over) return abs(dot(n, a)) / length(n);
  return std::min(
      {distance_of_segment(a, b), distance_of_segment(b, c), distance_of_segment(c, a)});
}

CoreVector random_direction(Random& random) {
  const Eigen::Vector3d d = random.direction();
  return {d.x(), d.y(), d.z()};
}

TEST(NearestOfSliver, DifferencesOfProductsAreRightToTheLastDigits) {
  Random random(1);
  for (uint32_t round = 0; round < rounds(20'000); ++round) {
    const double a = random.uniform(-2, 2), b = random.uniform(-2, 2);
    const double c =
        a * (1 + std::ldexp(random.uniform(-1, 1), -static_cast<int>(random.below(54))));
    const double d =
        b * (1 + std::ldexp(random.uniform(-1, 1), -static_cast<int>(random.below(54))));
    const Many truth = Many(a) * Many(b) - Many(c) * Many(d);
    const Many error = abs(Many(difference_of_products(a, b, c, d)) - truth);
    EXPECT_LE(error, abs(truth) * 0x1p-52 + abs(Many(a) * Many(b)) * 0x1p-102) << round;
  }
}

// With plain cross products the distance is off by up to 1e-16 over the sine of the triangle.
TEST(NearestOfSliver, IsAsFarAsItIs) {
  Random random(2);
  size_t over = 0, plainly_wrong = 0;
  const uint32_t count = rounds(20'000);
  for (uint32_t round = 0; round < count; ++round) {
    const CoreVector side = random_direction(random), up = random_direction(random);
    const CoreVector across = cross(side, up);
    const double thickness = std::pow(10.0, random.uniform(-14, -2));
    const CoreVector b = side * random.uniform(0.3, 1);
    const CoreVector c = side * random.uniform(0, 1) + across * thickness;
    double s = random.uniform(0, 1), t = random.uniform(0, 1);
    if (s + t > 1) s = 1 - s, t = 1 - t;
    const CoreVector n = cross(side, across);
    const CoreVector zero = b * s + c * t + n * (random.uniform(-1, 1) * thickness);
    NearestPoint::Corners corners;
    for (const CoreVector& corner : {CoreVector{0, 0, 0} - zero, b - zero, c - zero}) {
      corners.push_back(corner);
    }
    for (int turn = 0; turn < 3; ++turn) {
      // GJK adds a corner only if it leads nearer than the others do; the last one must take part.
      const NearestPoint found(corners);
      const Many truth =
          distance_of_triangle(exact(corners[0]), exact(corners[1]), exact(corners[2]));
      const CoreVector& way = found.point();
      const Many error = abs(length(exact(way)) - truth);
      EXPECT_LE(error, Many(0x1p-43)) << round;
      over += found.corners().size() == 3;
      const CoreVector u = corners[1] - corners[0], v = corners[2] - corners[0];
      const CoreVector plain = cross(u, v);
      const Many plain_distance = abs(dot(exact(plain), exact(corners[0]))) / length(exact(plain));
      plainly_wrong += found.corners().size() == 3 && abs(plain_distance - truth) > 1e-14;
      corners = {corners[1], corners[2], corners[0]};
    }
  }
  EXPECT_GT(over, count);
  EXPECT_GT(plainly_wrong, count / 20);
}

}  // namespace
}  // namespace carom::test
