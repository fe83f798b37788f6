// Meshes and compounds in cases with a known answer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "tests/support/composites.h"
#include "tests/support/hulls.h"

namespace carom::test {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3d;
using Eigen::Vector3f;

// The result of the reference, after checking that all ISAs and both orders give the same.
reference::PairResult result_of(const TestPair& pair,
                                PositionType positions = PositionType::float32) {
  for (const TestPair& each : {pair, swapped(pair)}) {
    Call call = call_with(positions);
    call.detail = Detail::manifold;
    expect_reference({&each, 1}, call);
  }
  return reference_result(pair, positions);
}

void expect_near(const Vector3f& actual, const Vector3f& expected, float tolerance = 1e-5f) {
  EXPECT_LE((actual - expected).norm(), tolerance)
      << actual.transpose() << " instead of " << expected.transpose();
}

// The difference of the two positions is no double. Proofs are about the positions as they are.
TEST(CompositeCases, ProofsOfMeshesAreAboutPositionsAsStored) {
  const Mesh mesh = mesh_of({{-2, -2, 0}, {2, -2, 0}, {0, 2, 0}}, {{0, 1, 2}});
  for (const double z : {-0x1p-60, -0x1p-54, -0x1p-53, 0.0, 0x1p-60}) {
    SCOPED_TRACE(z);
    const TestPair pair = {{mesh, {0, 0, z}}, sphere(0, 0, 1, 1)};
    for (const TestPair& each : {pair, swapped(pair)}) {
      Call call = call_with(PositionType::float64);
      call.accuracy.tier = Tier::exact;
      EXPECT_EQ(run_rows({&each, 1}, call)[0].overlap, z >= 0);
      call.accuracy.tier = Tier::certified;
      EXPECT_THAT(run_rows({&each, 1}, call)[0].overlap, testing::AnyOf(z >= 0, kUndecided));
    }
  }
}

// The normal of a thick sliver depends on the last bits of its corners.
TEST(CompositeCases, ThickSliversAreAsTheShape) {
  const std::vector<Vector3f> corners = {{0x1.ac788ep-1f, 0x1.23a0b6p+1f, 0x1.552366p-3f},
                                         {0x1.6a85dp+0f, 0x1.1d36fcp+1f, 0x1.f5da76p-1f},
                                         {0x1.caa83ap-1f, 0x1.22f9a8p+1f, 0x1.febbd4p-3f}};
  const PlacedShape ball = {Sphere{0x1.2bc2a8p-1f},
                            {0x1.585f74b341d08p+0, 0x1.24db73d81bd82p+1, 0x1.2a01cac8dc288p-6}};
  const Mesh mesh = mesh_of(corners, {{0, 1, 2}}, {.thickness = 0.2f});
  const auto result = result_of({{mesh, Vector3d::Zero()}, ball}, PositionType::float64);
  EXPECT_NEAR(result.separation, -0x1.da735d59fba1cp-3, 1e-6);
}

// Case 64 of CASES.md.
TEST(CompositeCases, SphereOverAnInnerEdgeGetsTheNormalOfThePlane) {
  const Mesh ground = flat_grid(4, 5);
  for (const double x : {0.0, 1e-6, -0.3, 2.5, 4.999, 5.0}) {
    for (const double y : {0.0, 0.3, -2.5, 5.0}) {
      SCOPED_TRACE(testing::Message() << x << ", " << y);
      for (const double depth : {0.0, 0.001, 0.5, 2.0}) {
        const auto result = result_of({{ground, {0, 0, 0}}, sphere(x, y, 3 - depth, 3)});
        EXPECT_TRUE(result.overlap);
        EXPECT_NEAR(result.separation, -depth, 1e-5);
        expect_near(result.normal, {0, 0, 1});
        EXPECT_GE(result.manifold_count, 1);
        EXPECT_LE(result.manifold_count, 4);
      }
    }
  }
}

// The same from below: contacts at the back of a plane keep the plane's normal, too.
TEST(CompositeCases, SphereUnderAnInnerEdgeGetsTheNormalOfThePlane) {
  const auto result = result_of({{flat_grid(4, 5), {0, 0, 0}}, sphere(0.2, -0.2, -2.9, 3)});
  EXPECT_TRUE(result.overlap);
  expect_near(result.normal, {0, 0, -1});
}

// Case 45 of CASES.md.
TEST(CompositeCases, SegmentThroughTheMiddleOfATriangleHits) {
  const std::vector<Vector3f> corners = {{2832.862f, 200, -641.5822f},
                                         {2834.611f, 200.0066f, -643.3685f},
                                         {2834.289f, 200, -640.1809f}};
  const Mesh mesh = mesh_of(corners, {{0, 1, 2}});
  const Vector3d middle = (corners[0] + corners[1] + corners[2]).cast<double>() / 3;
  for (const Vector3f& way : {Vector3f(0, 10, 0), Vector3f(3, 5, 1), Vector3f(0, 0.01f, 0)}) {
    const auto result =
        result_of({{mesh, {0, 0, 0}}, capsule(middle, -way, way, 0)}, PositionType::float64);
    EXPECT_TRUE(result.overlap);
  }
}

TEST(CompositeCases, BoxesThatSlideOverAGridMeetThePlaneAlone) {
  const Mesh ground = flat_grid(6, 1);
  const Shape shapes[] = {Box{{0.8f, 0.5f, 0.3f}}, Aabb::from_half_extents({0.8f, 0.5f, 0.3f}),
                          Capsule{{-0.7f, 0, 0}, {0.7f, 0, 0}, 0.3f}};
  for (const Shape& shape : shapes) {
    for (int step = 0; step < 20; ++step) {
      const double x = -2 + 0.2 * step + 1e-3;
      const auto turn = Quaternionf(Eigen::AngleAxisf(0.1f * float(step), Vector3f::UnitZ()));
      const PlacedShape body = {shape, {x, 0.37 * x, 0.3 - 0.01}, turn};
      const auto result = result_of({{ground, {0, 0, 0}}, body});
      SCOPED_TRACE(step);
      EXPECT_TRUE(result.overlap);
      expect_near(result.normal, {0, 0, 1});
      EXPECT_NEAR(result.separation, -0.01, 1e-5);
      EXPECT_GE(result.manifold_count, 2);
      for (size_t i = 0; i < result.manifold_count; ++i) {
        EXPECT_GE(result.manifold.separation[i], result.separation);
      }
    }
  }
}

// A box lies on many triangles: the manifold has all four of its corners.
TEST(CompositeCases, ManifoldsSpreadOverAllTriangles) {
  const auto result = result_of(
      {{flat_grid(9, 0.5f), {0, 0, 0}}, oriented_box({0.1, -0.1, 0.45}, {1.5f, 1.25f, 0.5f})});
  ASSERT_EQ(result.manifold_count, 4);
  // Every point is at another corner; a triangle that contains a corner may give more points than
  // four.
  std::array<int, 4> corners{};
  for (const auto& point : result.manifold.point) {
    EXPECT_NEAR(std::fabs(point[0] - 0.1), 1.5, 0.1);
    EXPECT_NEAR(std::fabs(point[1] + 0.1), 1.25, 0.1);
    ++corners[(point[0] > 0 ? 1 : 0) + (point[1] > 0 ? 2 : 0)];
  }
  EXPECT_EQ(corners, (std::array{1, 1, 1, 1}));
}

// The area of the manifold's points, seen from above.
double area_of(const reference::PairResult& result) {
  std::vector<Vector3d> points;
  Vector3d middle = Vector3d::Zero();
  for (size_t i = 0; i < result.manifold_count; ++i) {
    const auto& p = result.manifold.point[i];
    points.emplace_back(p[0], p[1], 0);
    middle += points.back() / result.manifold_count;
  }
  const auto angle = [&](const Vector3d& p) {
    return std::atan2(p.y() - middle.y(), p.x() - middle.x());
  };
  std::sort(points.begin(), points.end(),
            [&](const Vector3d& p, const Vector3d& q) { return angle(p) < angle(q); });
  double area = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    area += points[i].cross(points[(i + 1) % points.size()]).z() / 2;
  }
  return area;
}

// A body is tilted by as little as rounding. Its contacts with most triangles are then over their
// inner edges.
TEST(CompositeCases, ManifoldsOfTiltedBodiesStaySpread) {
  oracle::Random random(17);
  const Shape shapes[] = {Box{{0.5f, 0.5f, 0.5f}}, oracle::hull_of(cube_corners(0.5f))};
  const Mesh ground = flat_grid(5, 1);
  for (const double tilt : {0.0, 1e-6, 1e-4, 1e-3, 1e-2}) {
    for (const Shape& shape : shapes) {
      for (int i = 0; i < 20; ++i) {
        const Vector3f axis = random.direction().cast<float>();
        const Quaternionf turn = Quaternionf(Eigen::AngleAxisf(float(tilt), axis.normalized())) *
                                 Eigen::AngleAxisf(float(random.uniform(0, 3)), Vector3f::UnitZ());
        const Vector3d at(random.uniform(-1, 1), random.uniform(-1, 1), 0.49 - 0.7 * tilt);
        const auto result = result_of({{ground, {0, 0, 0}}, {shape, at, turn}});
        SCOPED_TRACE(testing::Message() << "tilt " << tilt << ", place " << i);
        EXPECT_NEAR(result.normal.z(), 1, 1e-3);
        EXPECT_GT(area_of(result), 0.5);
      }
    }
  }
}

// A step in a floor keeps its edge: it stops a body that comes from the side.
TEST(CompositeCases, OuterEdgesAreNotLeftOut) {
  const auto result = result_of({{flat_grid(2, 1), {0, 0, 0}}, sphere(1.4, 0.1, 0, 0.5)});
  EXPECT_TRUE(result.overlap);
  expect_near(result.normal, {1, 0, 0});
}

// Triangles behind the edge of a sheet do not count, however many the body reaches.
TEST(CompositeCases, SheetsAreMetEdgeOn) {
  const auto result = result_of({{flat_grid(20, 0.1f), {0, 0, 0}}, sphere(1.6, 0.13, 0.05, 1)});
  EXPECT_TRUE(result.overlap);
  expect_near(result.normal, Vector3f(0.6f, 0, 0.05f).normalized(), 1e-4f);
}

TEST(CompositeCases, ConcaveEdgesGiveTheNormalsOfFaces) {
  // A valley with slopes of 45 degrees.
  const Mesh valley = grid_mesh(2, 1, [](float x, float) { return std::fabs(x); });
  const auto result = result_of({{valley, {0, 0, 0}}, sphere(0.01, 0.3, 0.69, 0.5)});
  EXPECT_TRUE(result.overlap);
  expect_near(result.normal, Vector3f(-1, 0, 1).normalized());
}

TEST(CompositeCases, OneSidedMeshesLetThroughWhatComesFromBehind) {
  const Mesh ground = flat_grid(2, 1, {.one_sided = true});
  const auto below = result_of({{ground, {0, 0, 0}}, sphere(0.1, 0.1, -0.1, 0.5)});
  EXPECT_FALSE(below.overlap);
  EXPECT_EQ(below.separation, HUGE_VALF);
  const auto above = result_of({{ground, {0, 0, 0}}, sphere(0.1, 0.1, 0.1, 0.5)});
  EXPECT_TRUE(above.overlap);
  expect_near(above.normal, {0, 0, 1});
}

TEST(CompositeCases, ThickMeshesReachBehindTheirFront) {
  const Mesh ground = flat_grid(2, 1, {.thickness = 1});
  const auto result = result_of({{ground, {0, 0, 0}}, sphere(0.3, 0.1, -1.3, 0.5)});
  EXPECT_TRUE(result.overlap);
  EXPECT_NEAR(result.separation, -0.2, 1e-5);
  expect_near(result.normal, {0, 0, -1});
}

// Triangles without area only take up indices.
TEST(CompositeCases, DegenerateTrianglesTakeNoPart) {
  const std::vector<Vector3f> corners = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}, {0, 0, 5}};
  const Mesh good = mesh_of(corners, {{0, 1, 2}});
  const Mesh more = mesh_of(corners, {{3, 3, 0}, {0, 3, 3}, {0, 1, 2}, {2, 2, 2}});
  EXPECT_EQ(more.geometry->degenerate_count(), 3u);
  for (const double z : {0.2, 3.0}) {
    const auto with = result_of({{more, {0, 0, 0}}, sphere(0.1, 0, z, 0.5)});
    const auto without = result_of({{good, {0, 0, 0}}, sphere(0.1, 0, z, 0.5)});
    EXPECT_EQ(with.sub_a, 2u);
    EXPECT_EQ(without.sub_a, 0u);
    EXPECT_EQ(with.separation, without.separation);
    EXPECT_EQ(with.normal, without.normal);
  }
  const Mesh nothing = mesh_of(corners, {{3, 3, 0}, {1, 1, 1}});
  const auto result = result_of({{nothing, {0, 0, 0}}, sphere(0, 0, 5, 0.5)});
  EXPECT_FALSE(result.overlap);
  EXPECT_EQ(result.separation, HUGE_VALF);
  EXPECT_TRUE(std::isnan(result.normal.x()));
  EXPECT_EQ(result.status, Status::ok);
}

TEST(CompositeCases, OrderOfTrianglesChangesIndicesAlone) {
  Composites composites(7);
  for (int round = 0; round < 20; ++round) {
    const Mesh mesh = composites.mesh(1);
    const auto triangles = mesh.geometry->triangles();
    std::vector<uint32_t> order(triangles.size());
    std::iota(order.begin(), order.end(), 0u);
    for (size_t i = order.size(); i > 1; --i) {
      std::swap(order[i - 1], order[composites.random().below(i)]);
    }
    Triangles shuffled;
    for (const uint32_t i : order) shuffled.push_back(mesh.geometry->corner_numbers(i));
    std::vector<Vector3f> vertices;
    for (size_t i = 0; i < mesh.geometry->vertices().size(); ++i) {
      vertices.push_back(mesh.geometry->vertex(i));
    }
    const Mesh other = mesh_of(vertices, shuffled, mesh.geometry->rules());
    TestPair pair =
        composites.pair(ShapeKind::mesh, ShapeKind::capsule, PositionType::float32, 1, 0);
    pair.a.shape = mesh;
    const auto first = result_of(pair);
    pair.a.shape = other;
    const auto second = result_of(pair);
    EXPECT_EQ(first.overlap, second.overlap);
    EXPECT_EQ(first.separation, second.separation);
    if (std::isfinite(first.separation) && triangles.size() > 0 &&
        order[second.sub_a] == first.sub_a) {
      EXPECT_EQ(first.normal, second.normal);
      EXPECT_EQ(first.arm_a, second.arm_a);
    }
  }
}

TEST(CompositeCases, CompoundsNameTheirDeepestChild) {
  const Compound dumbbell =
      compound_of({{Sphere{1}, {-3, 0, 0}, Quaternionf::Identity()},
                   {Capsule{{-3, 0, 0}, {3, 0, 0}, 0.1f}, {0, 0, 0}, Quaternionf::Identity()},
                   {Sphere{1}, {3, 0, 0}, Quaternionf::Identity()}});
  // A quarter turn about z puts the last sphere at y = 3.
  const Quaternionf quarter(1, 0, 0, 1);
  const auto result =
      result_of({{dumbbell, {10, 0, 0}, quarter}, oriented_box({10, 4.4, 0}, {0.5f, 0.5f, 0.5f})});
  EXPECT_TRUE(result.overlap);
  EXPECT_EQ(result.sub_a, 2u);
  EXPECT_EQ(result.sub_b, 0u);
  EXPECT_NEAR(result.separation, -0.1, 1e-5);
  expect_near(result.normal, {0, 1, 0});
  expect_near(result.arm_a, {0, 4, 0});
  // The bodies are separate; the capsule is the nearest child.
  const auto apart = result_of({{dumbbell, {10, 0, 0}, quarter}, sphere(12, 0, 0, 0.5)});
  EXPECT_FALSE(apart.overlap);
  EXPECT_EQ(apart.sub_a, 1u);
  EXPECT_NEAR(apart.separation, 1.4, 1e-5);
}

TEST(CompositeCases, AabbsOfCompoundsTurnWithThem) {
  const Compound compound =
      compound_of({{Aabb{{0, -1, -1}, {4, 1, 1}}, {0, 0, 0}, Quaternionf(0, 0, 0, 3)}});
  const Quaternionf quarter(1, 0, 0, 1);
  EXPECT_TRUE(result_of({{compound, {0, 0, 0}}, sphere(4.5, 0, 0, 0.6)}).overlap);
  EXPECT_FALSE(result_of({{compound, {0, 0, 0}}, sphere(0, 4.5, 0, 0.6)}).overlap);
  EXPECT_FALSE(result_of({{compound, {0, 0, 0}, quarter}, sphere(4.5, 0, 0, 0.6)}).overlap);
  EXPECT_TRUE(result_of({{compound, {0, 0, 0}, quarter}, sphere(0, 4.5, 0, 0.6)}).overlap);
}

TEST(CompositeCases, InvalidBodiesHaveNoAnswer) {
  const PlacedShape good = {flat_grid(2, 1), {0, 0, 0}};
  PlacedShape bad = good;
  for (int i = 0; i < 3; ++i) {
    bad = i == 0 ? PlacedShape{Mesh{}, {0, 0, 0}} : good;
    if (i == 1) bad.position.x() = std::numeric_limits<double>::quiet_NaN();
    if (i == 2) bad.orientation = Quaternionf(0, 0, 0, 0);
    std::vector<TestPair> pairs = {{good, sphere(0, 0, 0.4, 0.5)},
                                   {bad, sphere(0, 0, 0.4, 0.5)},
                                   {sphere(0, 0, 0.4, 0.5), good},
                                   {good, sphere(0, 0, 0.4, -1)}};
    for (const Detail detail : {Detail::overlap, Detail::contact, Detail::manifold}) {
      Call call;
      call.detail = detail;
      expect_reference(pairs, call);
    }
    EXPECT_EQ(reference_result(pairs[1], PositionType::float32).status, Status::invalid);
  }
}

// A box on a mesh of thousands of triangles.
TEST(CompositeCases, LargeMeshes) {
  const Mesh terrain = grid_mesh(
      40, 0.25f, [](float x, float y) { return 0.3f * std::sin(x) * std::cos(1.3f * y); });
  Composites composites(9);
  std::vector<TestPair> pairs;
  for (int i = 0; i < 6; ++i) {
    TestPair pair = composites.pair(ShapeKind::mesh, i < 4 ? ShapeKind::box : ShapeKind::compound,
                                    PositionType::float32, 1, 0);
    pair.a = {terrain, {0, 0, 0}};
    pair.b.position.z() = 0.4;
    pairs.push_back(pair);
  }
  Call call;
  call.detail = Detail::manifold;
  expect_reference(pairs, call);
}

}  // namespace
}  // namespace carom::test
