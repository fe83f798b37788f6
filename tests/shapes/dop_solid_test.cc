// The hulls of k-DOPs in few bytes.
#include "shapes/dop_solid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "oracle/random.h"
#include "shapes/dop_geometry.h"
#include "shapes/hull_features.h"

namespace carom::test {
namespace {

constexpr DopKind kKindsOfSolids[] = {DopKind::k6, DopKind::k14, DopKind::k18, DopKind::k26};

Eigen::Vector3f vector_of(const std::array<float, 4>& record) {
  return {record[0], record[1], record[2]};
}

TEST(DopDirections, AreThoseOfTheSlabs) {
  const DopDirections& directions = DopDirections::get();
  for (const DopKind kind : kKindsOfSolids) {
    for (size_t plane = 0; plane < static_cast<size_t>(kind); ++plane) {
      const auto& d = slab_directions(kind)[slab_of_plane(plane)];
      const Eigen::Vector3d expected =
          sign_of_plane(plane) * Eigen::Vector3d(d[0], d[1], d[2]).normalized();
      const size_t common = common_plane(kind, plane);
      ASSERT_LT(common, kDopPlanes);
      EXPECT_EQ(normal_of_dop_plane(common), expected);
      EXPECT_EQ(vector_of(directions.records()[common]), expected.cast<float>());
      for (size_t axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(directions.column(axis)[common], directions.records()[common][axis]);
      }
    }
  }
}

TEST(DopDirections, OfEdgesLieInBothPlanes) {
  for (size_t left = 0; left < kDopPlanes; ++left) {
    for (size_t right = 0; right < kDopPlanes; ++right) {
      const Eigen::Vector4f& found = DopDirections::get().edge(left, right);
      const Eigen::Vector3d edge = found.head<3>().cast<double>();
      EXPECT_EQ(found[3], 0);
      if (slab_of_plane(left) == slab_of_plane(right)) {
        EXPECT_TRUE(edge.isZero(0));
        continue;
      }
      const Eigen::Vector3d across = normal_of_dop_plane(left).cross(normal_of_dop_plane(right));
      EXPECT_NEAR(edge.norm(), 1, 1e-7);
      EXPECT_NEAR(edge.dot(across), across.norm(), 1e-7);
    }
  }
}

struct Solids {
  Hull dop;
  Hull plain;  // the same points and faces, with features of its own
};

Solids random_solids(DopKind kind, oracle::Random& random) {
  std::vector<Eigen::Vector3f> points(24);
  for (auto& p : points) {
    const auto size = static_cast<float>(random.uniform(0.5, 2));
    p = size * random.direction().cast<float>();
  }
  const Hull hull = hull_of(Dop::of_points(points, kind));
  std::vector<std::vector<uint32_t>> faces;
  for (const HullGeometry::Face& face : hull.geometry->faces()) {
    const auto corners = hull.geometry->corners(face);
    faces.emplace_back(corners.begin(), corners.end());
  }
  return {hull, {*make_hull(hull.geometry->points(), faces)}};
}

void expect_same_columns(const HullGeometry& found, const HullGeometry& expected) {
  for (size_t axis = 0; axis < 3; ++axis) {
    EXPECT_TRUE(std::equal(expected.column(axis), expected.column(axis) + expected.column_stride(),
                           found.column(axis)));
    for (size_t i = expected.points().size(); i < found.column_stride(); ++i) {
      EXPECT_EQ(found.column(axis)[i], found.column(axis)[0]);
    }
  }
}

// How far the points reach.
double height_of(const HullGeometry& hull, const Eigen::Vector3d& normal) {
  double height = -HUGE_VAL;
  for (const Eigen::Vector3f& point : hull.points()) {
    height = std::max(height, normal.dot(point.cast<double>()));
  }
  return height;
}

// Planes that are not those of a face have infinite height.
void expect_same_planes(const DopSolid& solid, const HullGeometry& hull) {
  const HullFeatures& of_dop = *hull.features();
  size_t finite = 0;
  for (size_t plane = 0; plane < 32; ++plane) finite += solid.heights()[plane] != HUGE_VALF;
  EXPECT_EQ(finite, hull.faces().size());
  ASSERT_GT(solid.plane_count(), 0u);
  EXPECT_NE(solid.heights()[solid.plane_count() - 1], HUGE_VALF);
  for (size_t plane = solid.plane_count(); plane < 32; ++plane) {
    EXPECT_EQ(solid.heights()[plane], HUGE_VALF);
  }
  size_t face = 0;
  for (size_t plane = 0; plane < kDopPlanes; ++plane) {
    if (solid.heights()[plane] == HUGE_VALF) continue;
    EXPECT_EQ(of_dop.normal(face), vector_of(DopDirections::get().records()[plane]));
    EXPECT_EQ(of_dop.height(face), solid.heights()[plane]);
    EXPECT_NEAR(height_of(hull, normal_of_dop_plane(plane)), solid.heights()[plane], 2e-7);
    ++face;
  }
}

TEST(DopSolid, HasThePlanesEdgesAndPointsOfTheHull) {
  oracle::Random random(81);
  size_t solids = 0, most_points = 0, most_edges = 0;
  for (const DopKind kind : kKindsOfSolids) {
    for (int round = 0; round < 100; ++round) {
      const auto [hull, plain] = random_solids(kind, random);
      const DopSolid* const solid = hull.geometry->dop_solid();
      EXPECT_EQ(solid != nullptr, hull.geometry->features() != nullptr);
      EXPECT_EQ(plain.geometry->dop_solid(), nullptr);
      if (!solid || !plain.geometry->features()) continue;
      ++solids;
      expect_same_columns(*hull.geometry, *plain.geometry);
      EXPECT_EQ(hull.geometry->column(0), solid->column(0));
      expect_same_planes(*solid, *hull.geometry);
      EXPECT_NEAR(solid->inner_radius(), plain.geometry->features()->inner_radius(), 1e-5);
      const auto edges = plain.geometry->features()->edges();
      ASSERT_EQ(solid->edge_count(), edges.size());
      for (size_t e = 0; e < edges.size(); ++e) {
        const auto [from, left, right] = solid->edge(e);
        EXPECT_EQ(from, edges[e].from);
        EXPECT_EQ(solid->sides(0)[e], left);
        EXPECT_EQ(solid->sides(1)[e], right);
        const Eigen::Vector3f point = hull.geometry->points()[from];
        for (const uint32_t plane : {left, right}) {
          const Eigen::Vector3f normal = vector_of(DopDirections::get().records()[plane]);
          EXPECT_NEAR(normal.dot(point), solid->heights()[plane], 2e-6);
        }
        // Short edges have no good direction of their own.
        const Eigen::Vector3f along = edges[e].direction.head<3>();
        EXPECT_GT(along.dot(DopDirections::get().edge(left, right).head<3>()), 0.9f);
      }
      most_points = std::max(most_points, hull.geometry->points().size());
      most_edges = std::max(most_edges, edges.size());
    }
  }
  EXPECT_GT(solids, 380u);
  EXPECT_EQ(most_points, DopSolid::kMostPoints);
  EXPECT_EQ(most_edges, DopSolid::kMostEdges);
}

}  // namespace
}  // namespace carom::test
