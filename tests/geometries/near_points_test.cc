// Triangles are left out only if they are apart from the points, bounds of gaps lie below the true
// gaps, and all ISAs find the same.
#include "geometries/near_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "carom/shapes/shape.h"
#include "oracle/convex_oracle.h"
#include "oracle/random.h"
#include "tests/support/isas.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using Eigen::Vector3d;
using oracle::Random;

struct SomeTriangles {
  std::vector<float> vertices;
  std::vector<std::array<uint32_t, 3>> corners;

  // Triangles of about this size, at up to `spread` from the middle.
  SomeTriangles(size_t count, const Vector3d& middle, double spread, double size, bool has_slivers,
                Random& random) {
    for (uint32_t i = 0; i < count; ++i) {
      const double distance = spread * random.uniform(0, 1);
      const Vector3d at = middle + distance * random.direction();
      for (uint32_t k = 0; k < 3; ++k) {
        const double arm = size * random.uniform(0, 1);
        Vector3d p = at + arm * random.direction();
        if (has_slivers && k == 2 && i % 4 == 3) p = on_first_side(random.uniform(0, 1));
        for (int axis = 0; axis < 3; ++axis) vertices.push_back(static_cast<float>(p[axis]));
      }
      corners.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
  }

  // A point of the first side of the last triangle.
  Vector3d on_first_side(double share) const {
    const float* const v = vertices.data() + vertices.size() - 6;
    const Vector3d a(v[0], v[1], v[2]), b(v[3], v[4], v[5]);
    return a + share * (b - a);
  }

  TriangleArrays arrays() const { return {vertices.data(), corners.data(), corners.size()}; }

  Triangle triangle(size_t i) const {
    const auto at = [&](size_t k) {
      const float* v = vertices.data() + size_t{3} * corners[i][k];
      return Eigen::Vector3f(v[0], v[1], v[2]);
    };
    return {{at(0), at(1), at(2)}};
  }
};

// A turned box, and its corners.
struct TurnedBox {
  Box box;
  Pose pose;
  std::vector<Double3> corners;

  TurnedBox(const Vector3d& middle, double size, Random& random) {
    for (int axis = 0; axis < 3; ++axis) {
      box.half[axis] = static_cast<float>(size * random.uniform(0.2, 1));
    }
    const Vector3d turn = random.direction();
    const auto w = static_cast<float>(random.uniform(-1, 1));
    pose.position = middle;
    pose.orientation =
        Eigen::Quaternionf(w, static_cast<float>(turn.x()), static_cast<float>(turn.y()),
                           static_cast<float>(turn.z()));
    const Eigen::Matrix3d rotation = pose.orientation.cast<double>().normalized().matrix();
    for (size_t i = 0; i < 8; ++i) {
      Vector3d corner = box.half.cast<double>();
      for (int axis = 0; axis < 3; ++axis) corner[axis] *= (i >> axis & 1) != 0 ? 1 : -1;
      const Vector3d placed = middle + rotation * corner;
      corners.push_back({placed.x(), placed.y(), placed.z()});
    }
  }

  double separation(const Triangle& triangle) const {
    const oracle::ConvexShape<> a(box, pose), b(triangle, Pose{});
    return static_cast<double>(oracle::exact_separation(a, b));
  }
};

std::vector<uint32_t> numbers_below(size_t count) {
  std::vector<uint32_t> numbers(count);
  for (uint32_t i = 0; i < count; ++i) numbers[i] = i;
  return numbers;
}

// The same on every ISA.
NearPoints near_on_every_isa(const SomeTriangles& triangles, const SeenPoints& points, float most,
                             const std::vector<uint32_t>& numbers) {
  NearPoints first;
  bool is_first = true;
  for_each_isa([&] {
    NearPoints near;
    keep_near_points(triangles.arrays(), points, most, numbers, near);
    if (is_first) first = near;
    is_first = false;
    ASSERT_EQ(near.count, first.count);
    for (size_t i = 0; i < near.count; ++i) {
      EXPECT_EQ(near.triangle[i], first.triangle[i]);
      EXPECT_EQ(near.gap[i], first.gap[i]);
    }
  });
  return first;
}

TEST(NearPoints, BoundsLieBelowSeparations) {
  size_t apart = 0, left_out = 0, deep = 0, near_bounds = 0;
  for (const double unit : {1e-30, 1e-3, 1.0, 1e6, 1e30}) {
    SCOPED_TRACE(unit);
    Random random(3);
    for (const size_t count : {0, 1, 3, 4, 5, 7, 8, 9, 15, 16, 17, 130}) {
      for (int round = 0; round < 4; ++round) {
        const Vector3d middle = unit * random.uniform(0, 30) * random.direction();
        const TurnedBox box(middle, unit, random);
        const SomeTriangles triangles(count, middle, 2.5 * unit, 2 * unit, true, random);
        const double most = random.chance(0.5) ? 0 : 0.2 * unit;
        SeenPoints points;
        points.set(box.corners, Double3{middle.x(), middle.y(), middle.z()}, 2 * unit);
        const std::vector<uint32_t> numbers = numbers_below(count);
        const auto in_units = static_cast<float>(most * points.down);
        const NearPoints near = near_on_every_isa(triangles, points, in_units, numbers);
        size_t place = 0;
        for (const uint32_t i : numbers) {
          const double separation = box.separation(triangles.triangle(i));
          const bool is_kept = place < near.count && near.triangle[place] == i;
          if (is_kept) {
            EXPECT_LE(near.gap[place] * points.up, separation);
          } else {
            EXPECT_GT(separation, most);
          }
          apart += separation > most;
          left_out += !is_kept;
          deep += is_kept && separation < 0;
          near_bounds +=
              is_kept && separation < 0 && near.gap[place] * points.up > separation - 0.1 * unit;
          place += is_kept;
        }
        EXPECT_EQ(place, near.count);
      }
    }
  }
  EXPECT_GT(deep, 500u);
  EXPECT_GT(static_cast<double>(left_out), 0.8 * static_cast<double>(apart));
  EXPECT_GT(static_cast<double>(near_bounds), 0.6 * static_cast<double>(deep));
}

// Bounds along the normals of the triangle and of its sides hold but for rounding.
TEST(NearPoints, BoundsReachTheGapsOfPlanes) {
  Random random(4);
  for (uint32_t round = 0; round < rounds(200); ++round) {
    const Vector3d middle = random.uniform(0, 100) * random.direction();
    const TurnedBox box(middle, 1, random);
    const SomeTriangles triangles(8, middle, 2, 2, false, random);
    SeenPoints points;
    points.set(box.corners, Double3{middle.x(), middle.y(), middle.z()}, 2);
    const NearPoints near = near_on_every_isa(triangles, points, 1e6f, numbers_below(8));
    ASSERT_EQ(near.count, 8u);
    for (size_t i = 0; i < 8; ++i) {
      const Triangle t = triangles.triangle(i);
      const Vector3d corner[3] = {t.corners[0].cast<double>(), t.corners[1].cast<double>(),
                                  t.corners[2].cast<double>()};
      Vector3d normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
      if (normal.dot(middle - corner[0]) < 0) normal = -normal;
      std::vector<Vector3d> ways = {normal};
      for (int k = 0; k < 3; ++k) {
        const Vector3d side = corner[(k + 1) % 3] - corner[k];
        Vector3d beside = side.cross(normal).normalized();
        if (beside.dot(corner[(k + 2) % 3] - corner[k]) > 0) beside = -beside;
        ways.push_back(beside);
        ways.push_back((normal + beside).normalized());
      }
      for (const Vector3d& way : ways) {
        double low = HUGE_VAL;
        for (const Double3& p : box.corners) low = std::min(low, way.dot(Vector3d(p.data())));
        const double high = std::max({way.dot(corner[0]), way.dot(corner[1]), way.dot(corner[2])});
        EXPECT_GE(near.gap[i] * points.up, low - high - 1e-4);
      }
    }
  }
}

TEST(NearPoints, TrianglesWithoutAreaOrFarOffAreKept) {
  Random random(5);
  const Vector3d middle(1, 2, 3);
  const TurnedBox box(middle, 1, random);
  SomeTriangles triangles(4, {100, 0, 0}, 1, 1, false, random);
  triangles.corners[0][1] = triangles.corners[0][2];
  triangles.corners[1] = {3, 3, 3};
  triangles.vertices[3 * 6] = 3e38f;
  triangles.vertices[3 * 9] = -1e30f;
  SeenPoints points;
  points.set(box.corners, Double3{1, 2, 3}, 2);
  const NearPoints near = near_on_every_isa(triangles, points, 0, numbers_below(4));
  ASSERT_EQ(near.count, 4u);
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(near.gap[i], -HUGE_VALF);
}

}  // namespace
}  // namespace carom::test
