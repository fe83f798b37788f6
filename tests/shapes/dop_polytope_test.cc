// Points, edges and faces of k-DOPs.
#include "shapes/dop_polytope.h"

#include <gtest/gtest.h>

#include <cfloat>
#include <limits>
#include <set>
#include <vector>

#include "oracle/random.h"
#include "tests/support/hulls.h"

namespace carom::test {

using namespace oracle;
namespace {

constexpr DopKind kKinds[] = {DopKind::k6, DopKind::k14, DopKind::k18, DopKind::k26};

// A k-DOP whose slabs all have the same width, `scale` times the length of their direction.
Dop even_dop(DopKind kind, double scale) {
  Dop dop{.kind = kind};
  for (size_t i = 0; i < slab_count(kind); ++i) {
    const auto& d = slab_directions(kind)[i];
    const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    dop.upper[i] = static_cast<float>(scale * length);
    dop.lower[i] = -dop.upper[i];
  }
  return dop;
}

size_t area_faces(const DopPolytope& polytope) {
  size_t count = 0;
  for (const DopFace& face : polytope.faces()) count += face.count >= 3;
  return count;
}

std::vector<Double3> points_of(const DopPolytope& polytope) {
  std::vector<Double3> points;
  for (size_t i = 0; i < polytope.point_count(); ++i) points.push_back(polytope.point(i));
  return points;
}

// The counts fit Euler's formula, and are the greatest possible ones.
TEST(DopPolytope, OfEvenSlabs) {
  const std::array<std::array<size_t, 3>, 4> expected = {
      {{8, 12, 6}, {24, 36, 14}, {32, 48, 18}, {48, 72, 26}}};
  for (size_t i = 0; i < 4; ++i) {
    for (const double scale : {1e-30, 1.0, 1e18}) {
      const DopPolytope polytope{DopSlabs(even_dop(kKinds[i], scale))};
      SCOPED_TRACE(static_cast<int>(kKinds[i]));
      EXPECT_EQ(polytope.point_count(), expected[i][0]);
      EXPECT_EQ(polytope.edges().size(), expected[i][1]);
      EXPECT_EQ(area_faces(polytope), expected[i][2]);
    }
  }
}

// Vectors of numbers are read from columns without looking at the count.
TEST(DopPolytope, ColumnsBeginAtLinesAndRepeatTheLastPoint) {
  for (const DopKind kind : kKinds) {
    const DopPolytope polytope{DopSlabs(even_dop(kind, 1.0))};
    const size_t count = polytope.point_count();
    for (size_t axis = 0; axis < 3; ++axis) {
      const double* const column = polytope.column(axis);
      EXPECT_EQ(reinterpret_cast<uintptr_t>(column) % 64, 0u);
      for (size_t i = count; i % DopPolytope::kPadding != 0; ++i) {
        EXPECT_EQ(column[i], column[count - 1]);
      }
    }
  }
}

double along(const std::array<int8_t, 3>& d, const Double3& x) {
  return d[0] * x[0] + d[1] * x[1] + d[2] * x[2];
}

// Every point lies in all slabs, and every tight slab has a point at each end.
void expect_tight(const Dop& dop) {
  const DopPolytope polytope{DopSlabs(dop)};
  ASSERT_FALSE(polytope.is_empty());
  double size = 0;
  for (const Double3& x : points_of(polytope)) size = std::max(size, greatest(x));
  // The only difference is the rounding of the slabs to floats.
  const double rounding = size * 0x1p-21;
  for (size_t i = 0; i < slab_count(dop.kind); ++i) {
    double lower = HUGE_VAL, upper = -HUGE_VAL;
    for (const Double3& x : points_of(polytope)) {
      lower = std::min(lower, along(slab_directions(dop.kind)[i], x));
      upper = std::max(upper, along(slab_directions(dop.kind)[i], x));
    }
    EXPECT_NEAR(lower, dop.lower[i], rounding) << "slab " << i;
    EXPECT_NEAR(upper, dop.upper[i], rounding) << "slab " << i;
  }
}

TEST(DopPolytope, OfPoints) {
  Random random(1);
  for (const DopKind kind : kKinds) {
    for (const size_t count : {1, 2, 3, 4, 8, 40}) {
      for (int i = 0; i < 50; ++i) {
        Points points(count);
        for (auto& p : points) p = random.direction().cast<float>();
        SCOPED_TRACE(std::to_string(static_cast<int>(kind)) + ", " + std::to_string(count));
        expect_tight(Dop::of_points(points, kind));
      }
    }
  }
}

// Both faces of an edge contain it, and corners run counter-clockwise.
TEST(DopPolytope, EdgesAndFacesFitTogether) {
  Random random(2);
  for (const DopKind kind : kKinds) {
    Points points(20);
    for (auto& p : points) p = random.direction().cast<float>();
    const Dop dop = Dop::of_points(points, kind);
    const DopPolytope polytope{DopSlabs(dop)};
    const auto height = [&](size_t plane, const Double3& x) {
      const size_t slab = slab_of_plane(plane);
      const double end = plane % 2 ? dop.lower[slab] : dop.upper[slab];
      return (along(slab_directions(kind)[slab], x) - end) * sign_of_plane(plane);
    };
    std::set<std::pair<int, int>> known;
    for (const DopEdge& edge : polytope.edges()) {
      EXPECT_NEAR(height(edge.planes[0], polytope.point(edge.start)), 0, 1e-13);
      EXPECT_NEAR(height(edge.planes[1], polytope.point(edge.start)), 0, 1e-13);
      EXPECT_TRUE(known.insert(std::minmax<int>(edge.planes[0], edge.planes[1])).second);
    }
    for (const DopFace& face : polytope.faces()) {
      const auto& d = slab_directions(kind)[slab_of_plane(face.plane)];
      const Eigen::Vector3d normal = Eigen::Vector3d(d[0], d[1], d[2]) * sign_of_plane(face.plane);
      Eigen::Vector3d area = Eigen::Vector3d::Zero();
      const auto corners = polytope.corners(face);
      for (size_t i = 0; i < corners.size(); ++i) {
        const Double3 corner = polytope.point(corners[i].point);
        const Double3 next = polytope.point(corners[(i + 1) % corners.size()].point);
        area += Eigen::Map<const Eigen::Vector3d>(corner.data())
                    .cross(Eigen::Map<const Eigen::Vector3d>(next.data()));
        EXPECT_NEAR(height(face.plane, corner), 0, 1e-13);
      }
      EXPECT_GE(area.dot(normal), -1e-12);
    }
  }
}

TEST(DopPolytope, OfRedundantSlabs) {
  Dop dop = even_dop(DopKind::k26, 1);
  for (size_t i = 3; i < 13; ++i) dop.upper[i] = -(dop.lower[i] = -100);
  const DopPolytope cube{DopSlabs(dop)};
  EXPECT_EQ(cube.point_count(), 8u);
  EXPECT_EQ(cube.edges().size(), 12u);
  EXPECT_EQ(area_faces(cube), 6u);
}

// An octahedron whose axis slabs are so wide that they do not bound it.
TEST(DopPolytope, OfFarOffSlabs) {
  for (const float far : {3.0f, 1e9f, 1e30f, FLT_MAX}) {
    Dop dop{.kind = DopKind::k14};
    for (size_t i = 0; i < 7; ++i) dop.upper[i] = -(dop.lower[i] = i < 3 ? -far : -3.0f);
    const DopPolytope octahedron{DopSlabs(dop)};
    EXPECT_EQ(octahedron.edges().size(), 12u);
    EXPECT_EQ(area_faces(octahedron), 8u);
    for (const Double3& x : points_of(octahedron)) EXPECT_NEAR(greatest(x), 3, 1e-12);
    EXPECT_EQ(DopSlabs(dop).with_tight_axes().size(), 3);
  }
}

TEST(DopPolytope, OfFlatSlabs) {
  for (const DopKind kind : kKinds) {
    Points square = {{1, 1, 2}, {-1, 1, 2}, {-1, -1, 2}, {1, -1, 2}};
    const DopPolytope flat{DopSlabs(Dop::of_points(square, kind))};
    for (const Double3& x : points_of(flat)) EXPECT_EQ(x[2], 2);
    EXPECT_EQ(area_faces(flat), 2u);
    const Points segment = {{1, 1, 2}, {-1, 1, 2}};
    const DopPolytope line{DopSlabs(Dop::of_points(segment, kind))};
    EXPECT_EQ(area_faces(line), 0u);
    EXPECT_GE(line.edges().size(), 1u);
    const Points point = {{1, 1, 2}};
    const DopPolytope nothing{DopSlabs(Dop::of_points(point, kind))};
    EXPECT_EQ(nothing.edges().size(), 0u);
    for (const Double3& x : points_of(nothing)) EXPECT_EQ(x, (Double3{1, 1, 2}));
  }
}

TEST(DopPolytope, WhatHasNoPointIsNotValid) {
  Dop dop = even_dop(DopKind::k18, 1);
  EXPECT_TRUE(is_valid_dop(dop));
  dop.lower[3] = 3;  // x + y lies beyond the corners of the cube
  dop.upper[3] = 4;
  EXPECT_FALSE(is_valid_dop(dop));
  EXPECT_TRUE(DopPolytope(DopSlabs(dop)).is_empty());
  dop.lower[3] = 2;
  EXPECT_TRUE(is_valid_dop(dop));
  dop.kind = static_cast<DopKind>(7);
  EXPECT_FALSE(is_valid_dop(dop));
}

// Rounding leaves the slabs of a point without a common point; the polytope is computed from slabs
// widened by half a unit.
TEST(DopPolytope, OfAnySinglePoint) {
  Random random(3);
  for (const DopKind kind : kKinds) {
    for (int i = 0; i < 300; ++i) {
      const double size = random.log_uniform(1e-44, 1e37);
      const Points point = {(random.direction() * size).cast<float>()};
      const Dop dop = Dop::of_points(point, kind);
      EXPECT_TRUE(is_valid_dop(dop));
      const DopPolytope polytope{DopSlabs(dop)};
      for (const Double3& x : points_of(polytope)) {
        const double off = greatest(minus(x, {point[0].x(), point[0].y(), point[0].z()}));
        EXPECT_LE(off, 0x1p-21 * size);
      }
    }
  }
}

TEST(DopPolytope, NotANumberWhereAPointIsNone) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const DopKind kind : kKinds) {
    const Points points = {{0, 0, 0}, {1, nan, 1}, {2, 2, 2}};
    EXPECT_FALSE(is_valid_dop(Dop::of_points(points, kind)));
  }
}

}  // namespace
}  // namespace carom::test
