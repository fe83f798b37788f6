#include "cli/check/mesh_check.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "cli/check/convexity.h"

namespace carom::cli {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using Triangles = std::vector<std::array<uint32_t, 3>>;

struct TestMesh {
  std::vector<Vector3f> vertices;
  Triangles triangles;

  MeshReport check() const { return check_mesh(vertices, triangles); }
};

// A unit cube: bit k of a vertex index gives its coordinate k; every side has `steps` x `steps`
// squares of two triangles.
TestMesh cube(int steps = 1) {
  TestMesh mesh;
  const auto add_side = [&](const Vector3f& origin, const Vector3f& u, const Vector3f& v) {
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    const auto n = static_cast<uint32_t>(steps);
    for (uint32_t i = 0; i <= n; ++i) {
      for (uint32_t j = 0; j <= n; ++j) {
        mesh.vertices.push_back(origin + (u * static_cast<float>(i) + v * static_cast<float>(j)) /
                                             static_cast<float>(n));
      }
    }
    for (uint32_t i = 0; i < n; ++i) {
      for (uint32_t j = 0; j < n; ++j) {
        const uint32_t a = first + i * (n + 1) + j;
        mesh.triangles.push_back({a, a + n + 1, a + n + 2});
        mesh.triangles.push_back({a, a + n + 2, a + 1});
      }
    }
  };
  const Vector3f x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), o(0, 0, 0);
  add_side(o, y, x);
  add_side(z, x, y);
  add_side(o, x, z);
  add_side(y, z, x);
  add_side(o, z, y);
  add_side(x, y, z);
  return mesh;
}

TestMesh tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

TEST(MeshCheck, TetrahedronIsFine) {
  const MeshReport report = tetrahedron().check();
  EXPECT_TRUE(report.is_watertight());
  EXPECT_TRUE(report.is_convex());
  EXPECT_FALSE(report.inside_out);
  EXPECT_EQ(report.vertices, 4u);
  EXPECT_EQ(report.triangles, 4u);
  EXPECT_EQ(report.duplicate_vertices.count + report.unused_vertices, 0u);
}

TEST(MeshCheck, CubeOfUnsharedVerticesIsClosed) {
  const MeshReport report = cube(3).check();
  EXPECT_TRUE(report.is_watertight());
  EXPECT_TRUE(report.is_convex());
  EXPECT_EQ(report.duplicate_vertices.count, 6u * 16u - 56u);
  EXPECT_EQ(report.duplicate_vertices.first.size(), Findings<int>::kKept);
}

TEST(MeshCheck, RoundedAndTurnedCubesAreConvex) {
  for (int run = 0; run < 9; ++run) {
    TestMesh mesh = cube(1 + run);
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(run, Vector3d(1, 2, 3).normalized()));
    for (Vector3f& v : mesh.vertices) {
      const Vector3d p = (v - Vector3f::Constant(0.5f)).cast<double>();
      v = (Vector3d(1, 0.01 * run, -2) + turn * p).cast<float>();
    }
    const MeshReport report = mesh.check();
    EXPECT_TRUE(report.is_convex()) << run;
    EXPECT_TRUE(report.is_watertight()) << run;
  }
}

TEST(MeshCheck, NamesTheOpenEdges) {
  TestMesh mesh = tetrahedron();
  mesh.triangles.pop_back();
  const MeshReport report = mesh.check();
  EXPECT_FALSE(report.is_watertight());
  EXPECT_TRUE(report.is_convex());
  ASSERT_EQ(report.open_edges.count, 3u);
  const MeshEdge& edge = report.open_edges.first[0];
  EXPECT_EQ(edge.from, 2u);  // the triangle {0, 2, 1} goes from 2 to 1
  EXPECT_EQ(edge.to, 1u);
  EXPECT_EQ(edge.triangle, 0u);
  EXPECT_EQ(edge.triangles, 1u);
}

TEST(MeshCheck, NamesCrowdedAndOpposedEdges) {
  TestMesh mesh = tetrahedron();
  mesh.vertices.push_back({1, 1, -1});
  mesh.triangles.push_back({0, 1, 4});
  const MeshReport crowded = mesh.check();
  ASSERT_EQ(crowded.crowded_edges.count, 1u);
  EXPECT_EQ(crowded.crowded_edges.first[0].triangles, 3u);
  EXPECT_EQ(crowded.open_edges.count, 2u);
  EXPECT_FALSE(crowded.is_watertight());

  mesh = tetrahedron();
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  const MeshReport opposed = mesh.check();
  EXPECT_EQ(opposed.opposed_edges.count, 3u);
  EXPECT_FALSE(opposed.is_watertight());
}

TEST(MeshCheck, NamesDegenerateTriangles) {
  TestMesh mesh = tetrahedron();
  mesh.triangles.push_back({1, 1, 2});
  mesh.vertices.push_back({0.5f, 0, 0});
  mesh.triangles.push_back({0, 4, 1});
  const MeshReport report = mesh.check();
  ASSERT_EQ(report.repeated_index.count, 1u);
  EXPECT_EQ(report.repeated_index.first[0], 4u);
  ASSERT_EQ(report.without_area.count, 1u);
  EXPECT_EQ(report.without_area.first[0], 5u);
}

TEST(MeshCheck, SliversWithoutAreaCloseSurfaces) {
  // The edge 0-1 of one triangle is 0-4-1 in the other.
  TestMesh mesh = tetrahedron();
  mesh.vertices.push_back({0.5f, 0, 0});
  mesh.triangles = {{0, 2, 4}, {4, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  EXPECT_FALSE(mesh.check().is_watertight());
  mesh.triangles.push_back({0, 4, 1});
  EXPECT_TRUE(mesh.check().is_watertight());
  EXPECT_TRUE(mesh.check().is_convex());
}

TEST(MeshCheck, VerticesThatAreNotFinite) {
  TestMesh mesh = tetrahedron();
  mesh.vertices[2].y() = std::numeric_limits<float>::quiet_NaN();
  const MeshReport report = mesh.check();
  ASSERT_EQ(report.not_finite.count, 1u);
  EXPECT_EQ(report.not_finite.first[0], 2u);
  EXPECT_FALSE(report.is_convex());
  EXPECT_FALSE(report.is_watertight());
}

TEST(MeshCheck, NothingIsNeitherConvexNorClosed) {
  EXPECT_FALSE(check_mesh({}, {}).is_convex());
  EXPECT_FALSE(check_mesh({}, {}).is_watertight());
  const TestMesh point = {{{1, 2, 3}}, {{0, 0, 0}}};
  EXPECT_FALSE(point.check().is_convex());
}

TEST(MeshCheck, NamesTheEdgeThatIsBentInwards) {
  // One side of the cube has a pit of 0.1 in its middle.
  TestMesh mesh = cube(2);
  const Vector3f middle(0.5f, 0.5f, 1);
  for (Vector3f& v : mesh.vertices) {
    if (v == middle) v.z() = 0.9f;
  }
  const MeshReport report = mesh.check();
  EXPECT_TRUE(report.is_watertight());
  ASSERT_FALSE(report.is_convex());
  EXPECT_TRUE(report.dent->at_edge);
  EXPECT_GT(report.dent->height, 0.01);
  const MeshEdge& edge = report.dent->edge;
  EXPECT_TRUE(mesh.vertices[edge.from].z() == 0.9f || mesh.vertices[edge.to].z() == 0.9f);
}

TEST(MeshCheck, InsideOutIsSaid) {
  TestMesh mesh = cube(2);
  for (auto& corners : mesh.triangles) std::swap(corners[1], corners[2]);
  const MeshReport report = mesh.check();
  EXPECT_TRUE(report.inside_out);
  EXPECT_TRUE(report.is_convex());
  EXPECT_TRUE(report.is_watertight());
}

TEST(MeshCheck, TwoConvexPartsAreNotConvex) {
  TestMesh mesh = tetrahedron();
  for (size_t i = 0; i < 4; ++i) mesh.vertices.push_back(mesh.vertices[i] + Vector3f(5, 5, 5));
  for (size_t i = 0; i < 4; ++i) {
    const auto [a, b, c] = mesh.triangles[i];
    mesh.triangles.push_back({a + 4, b + 4, c + 4});
  }
  const MeshReport report = mesh.check();
  EXPECT_TRUE(report.is_watertight());
  ASSERT_FALSE(report.is_convex());
  EXPECT_FALSE(report.dent->at_edge);
  EXPECT_GT(report.dent->height, 7);
}

TEST(MeshCheck, AnySize) {
  const float largest = std::numeric_limits<float>::max();
  for (const float size : {largest, 1e-20f, 1e-44f}) {
    TestMesh mesh = tetrahedron();
    for (Vector3f& v : mesh.vertices) v *= size;
    EXPECT_TRUE(mesh.check().is_convex()) << size;
    EXPECT_TRUE(mesh.check().is_watertight()) << size;
  }
}

// Compares with a search through all points.
TEST(Convexity, HighestIsThatOfBruteForce) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<float> unit(-1, 1);
  for (int run = 0; run < 20; ++run) {
    std::vector<Vector3f> points(1 + random() % 3000);
    for (Vector3f& p : points) p = {unit(random), unit(random), unit(random)};
    const Convexity convexity(points);
    for (int i = 0; i < 20; ++i) {
      std::array<Vector3d, 3> corners;
      for (Vector3d& c : corners) c = Vector3d(unit(random), unit(random), unit(random)) * 1.2;
      const ConvexPlane plane = convexity.plane(corners);
      double expected = 0;
      for (const Vector3f& p : points) {
        expected = std::max(expected, plane.excess(p.cast<double>()));
      }
      const auto [vertex, height] = convexity.highest(plane);
      EXPECT_EQ(height, expected);
      if (height > 0) {
        EXPECT_EQ(plane.excess(points[vertex].cast<double>()), height);
      }
    }
  }
}

}  // namespace
}  // namespace carom::cli
