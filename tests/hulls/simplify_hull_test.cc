// Simpler hulls: on the right side, of few points, and no further away than stated. The checks try
// all features of a hull, in long double.
#include "carom/hulls/simplify_hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "carom/hulls/build_hull.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using Eigen::Vector3f;
using Vector = Eigen::Matrix<long double, 3, 1>;
using Points = std::vector<Vector3f>;

std::vector<Vector> exact(std::span<const Vector3f> points) {
  std::vector<Vector> result;
  for (const Vector3f& p : points) result.push_back(p.cast<long double>());
  return result;
}

long double to_segment(const Vector& p, const Vector& a, const Vector& b) {
  const Vector way = b - a;
  const long double length = way.squaredNorm();
  const long double t = length > 0 ? std::clamp(way.dot(p - a) / length, 0.0L, 1.0L) : 0.0L;
  return (a + t * way - p).norm();
}

long double to_triangle(const Vector& p, const Vector& a, const Vector& b, const Vector& c) {
  const Vector n = (b - a).cross(c - a);
  const auto is_left = [&](const Vector& u, const Vector& v) {
    return n.dot((v - u).cross(p - u)) >= 0;
  };
  if (n.squaredNorm() > 0 && is_left(a, b) && is_left(b, c) && is_left(c, a)) {
    return std::fabs(n.dot(p - a)) / n.norm();
  }
  return std::min({to_segment(p, a, b), to_segment(p, b, c), to_segment(p, c, a)});
}

// The planes of three points that have all others on one side. `visit` gets the triangle, the
// outward normal and the offset.
template <class Visit>
void for_each_supporting_plane(const std::vector<Vector>& points, const Visit& visit) {
  for (size_t i = 0; i < points.size(); ++i) {
    for (size_t j = i + 1; j < points.size(); ++j) {
      for (size_t k = j + 1; k < points.size(); ++k) {
        Vector n = (points[j] - points[i]).cross(points[k] - points[i]);
        if (!(n.norm() > 0)) continue;
        n.normalize();
        long double least = 0, most = 0;
        for (const Vector& p : points) {
          least = std::min(least, n.dot(p - points[i]));
          most = std::max(most, n.dot(p - points[i]));
        }
        const long double rounding = 1e-15L * (most - least);
        if (most <= rounding) visit(points[i], points[j], points[k], n);
        if (least >= -rounding) visit(points[i], points[j], points[k], Vector(-n));
      }
    }
  }
}

// How far points are outside of a hull of few points: brute force over all planes and triangles.
struct Outside {
  long double beyond = -std::numeric_limits<long double>::infinity();  // furthest beyond a plane
  long double distance = 0;  // of the furthest point outside
};

Outside outside(std::span<const Vector3f> of, std::span<const Vector3f> hull) {
  const std::vector<Vector> corners = exact(hull);
  Outside result;
  std::vector<long double> distance(of.size(), std::numeric_limits<long double>::infinity());
  std::vector<bool> is_outside(of.size(), false);
  const std::vector<Vector> points = exact(of);
  for_each_supporting_plane(
      corners, [&](const Vector& a, const Vector& b, const Vector& c, const Vector& n) {
        for (size_t i = 0; i < points.size(); ++i) {
          const long double beyond = n.dot(points[i] - a);
          result.beyond = std::max(result.beyond, beyond);
          is_outside[i] = is_outside[i] || beyond > 0;
          distance[i] = std::min(distance[i], to_triangle(points[i], a, b, c));
        }
      });
  for (size_t i = 0; i < points.size(); ++i) {
    if (is_outside[i]) result.distance = std::max(result.distance, distance[i]);
  }
  return result;
}

bool contains(std::span<const Vector3f> points, const Vector3f& p) {
  return std::any_of(points.begin(), points.end(), [&](const Vector3f& q) { return q == p; });
}

// Simplifies and checks everything; returns the error. Brute force from the original is left out
// where that has many points.
double checked(const Points& points, size_t most_points, HullSide side) {
  const auto simple = simplify_hull(points, {.most_points = most_points, .side = side});
  EXPECT_TRUE(simple) << simple.error().message;
  if (!simple) return 0;
  const auto corners = simple->geometry->points();
  EXPECT_LE(corners.size(), most_points);
  EXPECT_GE(corners.size(), std::min<size_t>(4, points.size()));
  EXPECT_GE(simple->error, 0);
  const auto original = build_hull(points);
  const auto original_points = original->geometry->points();
  // A hull of no more points is itself, and its points lie on the planes.
  const bool is_same = original_points.size() <= most_points;
  const long double rounding = is_same ? 1e-18L * original->geometry->size() : 0;
  if (side == HullSide::inside) {
    for (const Vector3f& corner : corners) EXPECT_TRUE(contains(original_points, corner));
    const Outside found = outside(original_points, corners);
    EXPECT_LE(found.distance, simple->error + rounding);
    EXPECT_GE(found.distance, simple->error * 0.999 - 1e-6 * original->geometry->size());
  } else if (side == HullSide::both) {
    if (original_points.size() <= 60) {
      const Outside there = outside(corners, original_points);
      const Outside back = outside(original_points, corners);
      const long double most = std::max(there.distance, back.distance);
      EXPECT_LE(most, simple->error + rounding);
      EXPECT_GE(most, simple->error * 0.999 - 1e-6 * original->geometry->size());
    }
    const auto inside =
        simplify_hull(points, {.most_points = most_points, .side = HullSide::inside});
    EXPECT_LE(simple->error, inside->error);
  } else {
    EXPECT_LE(outside(points, corners).beyond, rounding);
    if (original_points.size() <= 60) {
      const Outside found = outside(corners, original_points);
      EXPECT_LE(found.distance, simple->error + rounding);
      EXPECT_GE(found.distance, simple->error * 0.999 - 1e-6 * original->geometry->size());
    }
  }
  return simple->error;
}

using Random = std::mt19937_64;

Vector3f in_cube(Random& random) {
  std::uniform_real_distribution<float> unit(-1, 1);
  const float x = unit(random), y = unit(random);
  return {x, y, unit(random)};
}

Vector3f on_sphere(Random& random) {
  Vector3f p = in_cube(random);
  while (p.norm() < 0.1f || p.norm() > 1) p = in_cube(random);
  return p.normalized();
}

Points cloud(size_t count, uint64_t seed, bool sphere, const Vector3f& scale = Vector3f::Ones(),
             const Vector3f& place = Vector3f::Zero()) {
  Random random(seed);
  Points points;
  for (size_t i = 0; i < count; ++i) {
    points.push_back((sphere ? on_sphere(random) : in_cube(random)).cwiseProduct(scale) + place);
  }
  return points;
}

Points lattice(int side) {
  Points points;
  for (int i = 0; i < side * side * side; ++i) {
    points.emplace_back(static_cast<float>(i % side), static_cast<float>(i / side % side),
                        static_cast<float>(i / side / side));
  }
  return points;
}

TEST(SimplifyHull, OfCloudsAndSpheres) {
  for (const HullSide side : {HullSide::inside, HullSide::outside, HullSide::both}) {
    for (const size_t count : {5, 6, 9, 30, 200, 2000}) {
      if (count > rounds(2000, 30)) continue;
      for (const size_t most : {4, 5, 6, 7, 8, 12, 20}) {
        SCOPED_TRACE(std::to_string(count) + " to " + std::to_string(most));
        checked(cloud(count, count, false), most, side);
        checked(cloud(std::min<size_t>(count, 400), count, true), most, side);
      }
    }
  }
}

TEST(SimplifyHull, OfSliversAndFarBodies) {
  for (const HullSide side : {HullSide::inside, HullSide::outside, HullSide::both}) {
    for (const size_t most : {4, 8, 13}) {
      checked(cloud(50, 1, true, {1, 1, 1e-4f}), most, side);
      checked(cloud(50, 2, true, {1, 1e-3f, 1e-3f}), most, side);
      checked(cloud(50, 3, true, {1, 2, 3}, {1000, -500, 200}), most, side);
      checked(cloud(50, 4, true, Vector3f::Constant(1e20f)), most, side);
      checked(cloud(50, 5, true, Vector3f::Constant(1e-20f)), most, side);
      // thin along no axis
      Points diagonal = cloud(50, 6, true);
      for (Vector3f& p : diagonal) p += 200 * p.sum() * Vector3f(1, 2, 3);
      checked(diagonal, most, side);
    }
  }
}

TEST(SimplifyHull, OfBoxesAndLattices) {
  for (const HullSide side : {HullSide::inside, HullSide::outside, HullSide::both}) {
    for (const int corners : {2, 3, 5}) {
      for (const size_t most : {4, 5, 6, 7}) checked(lattice(corners), most, side);
      // A lattice is a box.
      for (const size_t most : {8, 9, 100}) {
        const auto box = simplify_hull(lattice(corners), {.most_points = most, .side = side});
        EXPECT_EQ(box->geometry->points().size(), 8u);
        EXPECT_LT(box->error, 1e-7);
      }
    }
  }
  // Corners that are cut off: the best box around it has them again.
  Points cut;
  for (const Vector3f& p : lattice(2)) {
    const Vector3f inwards = Vector3f::Ones() - 2 * p;
    for (int axis = 0; axis < 3; ++axis) {
      cut.push_back(p + 0.0625f * inwards[axis] * Vector3f::Unit(axis));
    }
  }
  EXPECT_LT(checked(cut, 8, HullSide::outside), 0.04);
}

TEST(SimplifyHull, OfAllPointsIsTheHullItself) {
  const Points points = cloud(rounds(300, 80), 1, false);
  const auto hull = build_hull(points);
  const size_t count = hull->geometry->points().size();
  const auto same = simplify_hull(hull->geometry->points(), {.most_points = count});
  EXPECT_EQ(same->geometry->points().size(), count);
  EXPECT_EQ(same->error, 0);
  for (const HullSide side : {HullSide::inside, HullSide::outside}) {
    const double error = checked(points, count - 1, side);
    EXPECT_GT(error, 0);
    EXPECT_LT(error, 0.2);
  }
}

TEST(SimplifyHull, DoesNotDependOnTheOrder) {
  Points points = cloud(500, 9, false);
  Random random(2);
  for (const HullSide side : {HullSide::inside, HullSide::outside}) {
    const auto first = simplify_hull(points, {.most_points = 15, .side = side});
    for (int run = 0; run < 3; ++run) {
      std::shuffle(points.begin(), points.end(), random);
      points.push_back(points[0]);
      const auto again = simplify_hull(points, {.most_points = 15, .side = side});
      const auto expected = first->geometry->points(), got = again->geometry->points();
      EXPECT_TRUE(std::equal(got.begin(), got.end(), expected.begin(), expected.end()));
      EXPECT_EQ(again->error, first->error);
    }
  }
}

TEST(SimplifyHull, OfFlatPoints) {
  Points circle;
  for (int i = 0; i < 40; ++i) {
    const float angle = 0.157079633f * static_cast<float>(i);
    circle.emplace_back(std::cos(angle), std::sin(angle), 2.0f);
  }
  const auto inside = simplify_hull(circle, {.most_points = 8, .side = HullSide::inside});
  ASSERT_TRUE(inside);
  EXPECT_EQ(inside->geometry->points().size(), 8u);
  EXPECT_LT(inside->error, 0.2);
  EXPECT_LT(checked(circle, 8, HullSide::outside), 0.5);  // a flat box

  const Points line = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {-1, -1, -1}};
  for (const HullSide side : {HullSide::inside, HullSide::outside}) {
    EXPECT_EQ(simplify_hull(line, {.side = side})->geometry->points().size(), 2u);
    EXPECT_EQ(simplify_hull(Points{{1, 2, 3}}, {.side = side})->geometry->points().size(), 1u);
  }
}

TEST(SimplifyHull, Refuses) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(simplify_hull({}));
  EXPECT_FALSE(simplify_hull(Points{{0, 0, 0}, {0, nan, 0}}));
  EXPECT_FALSE(simplify_hull(lattice(2), {.most_points = 3}));
}

}  // namespace
}  // namespace carom::test
