#include "tests/support/hull_checks.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/float_modes.h"

namespace carom::hulls {
namespace {

using Eigen::Vector3i;

BuiltHull built(const Points& points) {
  Result<BuiltHull> hull = build_hull(points);
  EXPECT_TRUE(hull) << (hull ? "" : hull.error().message);
  return hull ? *hull : BuiltHull{};
}

Points grid(int steps) {
  Points points;
  for (int x = 0; x <= steps; ++x) {
    for (int y = 0; y <= steps; ++y) {
      for (int z = 0; z <= steps; ++z) points.push_back(Vector3i(x, y, z).cast<float>());
    }
  }
  return points;
}

TEST(BuildHull, CubeHasSixFaces) {
  const Points points = grid(1);
  const BuiltHull hull = built(points);
  EXPECT_EQ(hull.form, HullForm::solid);
  EXPECT_EQ(hull.geometry->points().size(), 8u);
  ASSERT_EQ(hull.geometry->faces().size(), 6u);
  for (const HullGeometry::Face& face : hull.geometry->faces()) EXPECT_EQ(face.count, 4u);
  expect_faces_outside(points, hull, 0);
  expect_closed(hull);
}

TEST(BuildHull, PointsInsideAndOnFacesAndEdgesAreLeftOut) {
  Points points = grid(4);
  points.insert(points.end(), points.begin(), points.begin() + 10);
  const BuiltHull hull = built(points);
  EXPECT_EQ(hull.geometry->points().size(), 8u);
  EXPECT_EQ(hull.geometry->faces().size(), 6u);
  EXPECT_EQ(hull.duplicates, 10u);
  EXPECT_EQ(hull.inside, 125u - 8u);
  expect_subset(points, hull);
  expect_closed(hull);
}

TEST(BuildHull, IsTheSameInAnyFloatMode) {
  std::mt19937 random(5);
  std::normal_distribution<float> coordinate;
  for (int round = 0; round < 10; ++round) {
    Points points(30);
    for (auto& p : points) p = {coordinate(random), coordinate(random), coordinate(random)};
    const BuiltHull expected = built(points);
    for (const test::FloatMode& mode : test::float_modes()) {
      SCOPED_TRACE(mode.name);
      const test::ScopedFloatMode scoped(mode);
      const BuiltHull hull = built(points);
      const auto records = hull.geometry->records(), others = expected.geometry->records();
      EXPECT_TRUE(std::equal(records.begin(), records.end(), others.begin(), others.end()));
      EXPECT_EQ(hull.geometry->middle(), expected.geometry->middle());
    }
  }
}

TEST(BuildHull, PointsBecomeWhatTheyAre) {
  EXPECT_EQ(built({{1, 2, 3}}).form, HullForm::point);
  const BuiltHull point = built({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}});
  EXPECT_EQ(point.form, HullForm::point);
  EXPECT_EQ(point.duplicates, 2u);
  EXPECT_EQ(point.geometry->points().size(), 1u);
  EXPECT_EQ(built({{0.0f, 0, 0}, {-0.0f, 0, 0}}).form, HullForm::point);

  const BuiltHull segment = built({{1, 2, 3}, {3, 6, 9}, {-2, -4, -6}, {1, 2, 3}, {0, 0, 0}});
  EXPECT_EQ(segment.form, HullForm::segment);
  ASSERT_EQ(segment.geometry->points().size(), 2u);
  EXPECT_EQ(segment.geometry->points()[0], Vector3f(3, 6, 9));
  EXPECT_EQ(segment.geometry->points()[1], Vector3f(-2, -4, -6));
  EXPECT_TRUE(segment.geometry->faces().empty());
  EXPECT_EQ(built({{0, 0, 1}, {0, 0, 2}}).form, HullForm::segment);

  // Points in the plane x + y + z = 6; one is in the middle and one on an edge.
  const BuiltHull polygon =
      built({{6, 0, 0}, {2, 2, 2}, {0, 6, 0}, {3, 3, 0}, {0, 0, 6}, {-6, 6, 6}});
  EXPECT_EQ(polygon.form, HullForm::polygon);
  EXPECT_EQ(polygon.geometry->points().size(), 4u);
  ASSERT_EQ(polygon.geometry->faces().size(), 2u);
  const auto faces = polygon.geometry->faces();
  const Vector3d up = face_normal(*polygon.geometry, faces[0]);
  EXPECT_NEAR(std::abs(up.dot(Vector3d(1, 1, 1))), std::sqrt(3.0), 1e-12);
  EXPECT_NEAR((up + face_normal(*polygon.geometry, faces[1])).norm(), 0, 1e-12);
  expect_closed(polygon);
}

// The points of an edge lie straight above each other up to rounding, in random order.
TEST(BuildHull, UprightEdgesKeepTheirEnds) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<float> unit(-1, 1);
  for (int run = 0; run < 500; ++run) {
    Points points;
    for (int i = 0; i < 6; ++i) {
      const float off = std::ldexp(unit(random), -20 - static_cast<int>(random() % 40));
      points.push_back({off, i % 2 ? 2 * off : off, unit(random)});
    }
    points.push_back({1, 1, unit(random)});
    const BuiltHull hull = built(points);
    expect_subset(points, hull);
    expect_same_support(points, hull, random);
  }
}

// Facets 1e-15 thick that meet at 1e-11. They once hid end points, with an error of a thousandth of
// the size.
TEST(BuildHull, WedgesKeepTheirEnds) {
  const std::vector<Points> wedges = {{{1.13458409e-11f, 1.13458409e-11f, -0.672511578f},
                                       {-5.69627201e-12f, -1.1392544e-11f, -0.993408144f},
                                       {2.12684037e-12f, 2.12684037e-12f, -0.867225409f},
                                       {-1.13953968e-15f, -2.27907936e-15f, 0.231766343f},
                                       {1.81030169e-12f, 1.81030169e-12f, 0.120865464f},
                                       {9.4504806e-19f, 1.89009612e-18f, 0.23093152f},
                                       {1, 1, 0.655672073f}},
                                      {{-1.2390187e-11f, -1.2390187e-11f, 0.926223397f},
                                       {4.02496612e-12f, 8.04993225e-12f, -0.688188851f},
                                       {-8.3640061e-13f, -8.3640061e-13f, -0.957276881f},
                                       {-6.10485891e-13f, -1.22097178e-12f, 0.883849144f},
                                       {1.02122064e-18f, 1.02122064e-18f, -0.307504594f},
                                       {1.73165505e-18f, 3.4633101e-18f, -0.957466483f},
                                       {1, 1, 0.53594172f}}};
  std::mt19937_64 random(1);
  for (const Points& points : wedges) expect_same_support(points, built(points), random);
}

TEST(BuildHull, RefusesNothingAndWhatIsNotFinite) {
  EXPECT_FALSE(build_hull({}));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(build_hull(Points{{0, 0, 0}, {0, nan, 0}}));
  EXPECT_FALSE(build_hull(Points{{0, 0, -infinity}}));
}

TEST(BuildHull, RoundedFacesStayWhole) {
  std::mt19937_64 random(1);
  for (int run = 0; run < 50; ++run) {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(run, direction(random)));
    const Vector3d half = {1, run % 2 ? 0.05 : 2, 0.7};
    const Vector3d place = run % 3 ? Vector3d::Zero() : Vector3d(10, -5, 3);
    Points points;
    for (const Vector3f& p : grid(1)) {
      const Vector3d corner = (2 * p.cast<double>() - Vector3d::Ones()).cwiseProduct(half);
      points.push_back((place + turn * corner).cast<float>());
    }
    const BuiltHull hull = built(points);
    EXPECT_EQ(hull.geometry->points().size(), 8u);
    EXPECT_EQ(hull.geometry->faces().size(), 6u) << run;
    expect_faces_outside(points, hull, 1e-5);
    expect_closed(hull);
  }
}

TEST(BuildHull, RandomPointsOfAnySizeAndProportion) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> exponent(-28, 28), flat(-6, 0), unit(-1, 1);
  for (int run = 0; run < 300; ++run) {
    const size_t count = 4 + random() % 61;
    const double size = std::pow(10, exponent(random));
    Vector3d stretch = Vector3d::Constant(size);
    if (run % 2) stretch[static_cast<int>(random() % 3)] *= std::pow(10, flat(random));
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(run, direction(random)));
    const bool on_sphere = run % 3 == 0;
    Points points;
    for (size_t i = 0; i < count; ++i) {
      const Vector3d p =
          on_sphere ? direction(random) : Vector3d(unit(random), unit(random), unit(random));
      points.push_back((turn * p.cwiseProduct(stretch)).cast<float>());
    }
    const BuiltHull hull = built(points);
    EXPECT_EQ(hull.form, HullForm::solid);
    expect_subset(points, hull);
    expect_same_support(points, hull, random);
    expect_faces_outside(points, hull, 1e-5);
    if (run % 2) continue;
    expect_closed(hull);
    if (on_sphere) {
      EXPECT_EQ(hull.inside, 0u);
    }
  }
}

// A coarse grid has many points on one line and in one plane.
TEST(BuildHull, RandomPointsOfACoarseGrid) {
  std::mt19937_64 random(3);
  for (int run = 0; run < 500; ++run) {
    const int steps = 1 + static_cast<int>(random() % 4);
    const auto coordinate = [&] { return static_cast<float>(random() % (steps + 1)); };
    Points points(4 + random() % 40);
    for (Vector3f& p : points) {
      const float x = coordinate(), y = coordinate(), z = coordinate();
      p = run % 5 == 0 ? Vector3f(x, y, x + y) : Vector3f(x, y, z);
    }
    const BuiltHull hull = built(points);
    expect_subset(points, hull);
    expect_same_support(points, hull, random, 1e-12);
    expect_faces_outside(points, hull, 1e-12);
    if (hull.form >= HullForm::polygon) expect_closed(hull);
    if (run % 5 == 0) {
      EXPECT_LE(hull.form, HullForm::polygon);
    }
  }
}

TEST(BuildHull, LargestAndSmallestFloats) {
  const float largest = std::numeric_limits<float>::max();
  const float least = std::numeric_limits<float>::denorm_min();
  for (const float size : {largest, least, 3e38f, 1e-44f, 1e-38f}) {
    Points points;
    for (const Vector3f& p : grid(1)) points.push_back(size * (2 * p - Vector3f::Ones()));
    const BuiltHull hull = built(points);
    EXPECT_EQ(hull.form, HullForm::solid);
    EXPECT_EQ(hull.geometry->points().size(), 8u);
    EXPECT_EQ(hull.geometry->faces().size(), 6u);
  }
  const BuiltHull needle =
      built({{-largest, 0, 0}, {largest, 0, 0}, {0, least, 0}, {0, 0, least}, {0, -least, -least}});
  EXPECT_EQ(needle.form, HullForm::solid);
  EXPECT_EQ(needle.geometry->points().size(), 5u);
}

// A plane with a waviness of a float or two from rounding, and a thin rim.
TEST(BuildHull, AlmostFlatPointsKeepTheirCorners) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<float> unit(-1, 1);
  for (int run = 0; run < 200; ++run) {
    const Vector3f normal = direction(random).cast<float>();
    const float waviness = std::ldexp(1.0f, -static_cast<int>(random() % 30));
    Points points(3 + random() % 50);
    for (Vector3f& p : points) {
      const Vector3f q(unit(random), unit(random), unit(random));
      p = q - normal * (q.dot(normal) + waviness * unit(random));
    }
    const BuiltHull hull = built(points);
    expect_subset(points, hull);
    expect_same_support(points, hull, random);
  }
}

TEST(BuildHull, ClustersFarApart) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<float> unit(-1, 1);
  for (int run = 0; run < 100; ++run) {
    Points points;
    for (const Vector3f& place : {Vector3f(1, 0, 0), Vector3f(-1, 0, 0), Vector3f(0, 1, 1)}) {
      for (int i = 0; i < 12; ++i) {
        const float size = std::ldexp(1.0f, -static_cast<int>(random() % 40));
        points.push_back(place + size * Vector3f(unit(random), unit(random), unit(random)));
      }
    }
    const BuiltHull hull = built(points);
    expect_subset(points, hull);
    expect_same_support(points, hull, random);
  }
}

TEST(BuildHull, ManyPointsOfABall) {
  std::mt19937_64 random(6);
  Points points;
  for (int i = 0; i < 5000; ++i) points.push_back(direction(random).cast<float>());
  const BuiltHull hull = built(points);
  EXPECT_EQ(hull.geometry->points().size() + hull.inside, 5000u);
  EXPECT_GT(hull.geometry->points().size(), 4900u);
  expect_same_support(points, hull, random);
  expect_closed(hull);
}

TEST(BuildHull, NamesForms) {
  EXPECT_STREQ(name(HullForm::point), "point");
  EXPECT_STREQ(name(HullForm::solid), "solid");
}

}  // namespace
}  // namespace carom::hulls
