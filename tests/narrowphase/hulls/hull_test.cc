// Convex hulls: pairs with known answers, and changes that must not change the answer.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/checked_everywhere.h"
#include "tests/support/hulls.h"
#include "tests/support/kind_pairs.h"

namespace carom::test {
namespace {

using Eigen::AngleAxisf;
using Eigen::Quaternionf;
using Eigen::Vector3d;
using Eigen::Vector3f;
using Result = reference::PairResult;

constexpr auto kFloat64 = PositionType::float64;

Quaternionf turn(float angle, const Vector3f& axis) {
  return Quaternionf(AngleAxisf(angle, axis.normalized()));
}

double rounding(const TestPair& pair, const Result& result) {
  const double size = bounding_radius(pair.a.shape) + bounding_radius(pair.b.shape);
  return 4e-6 * (size + std::fabs(result.separation)) + 0x1p-140;
}

void expect_close(const TestPair& pair, const Result& result, const Result& other) {
  if (result.separation == other.separation) return;  // covers infinite separations
  EXPECT_NEAR(result.separation, other.separation, rounding(pair, result));
}

// --- Contact locations ---

TEST(Hulls, SphereAgainstFaceEdgeAndCorner) {
  const PlacedShape cube = placed_hull(cube_corners());
  const auto face = checked_everywhere({sphere(0.25, 0.5, 3, 0.5), cube});
  EXPECT_NEAR(face.separation, 1.5, 1e-6);
  EXPECT_EQ(face.normal, Vector3f(0, 0, -1));
  const auto edge = checked_everywhere({sphere(4, 5, 0.5, 1), cube});
  EXPECT_NEAR(edge.separation, 4, 2e-6);
  const auto corner = checked_everywhere({sphere(3, 3, 2, 1), cube});
  EXPECT_NEAR(corner.separation, 2, 2e-6);
  EXPECT_LE((corner.arm_b - Vector3f(1, 1, 1)).norm(), 2e-6f);
  const auto inside = checked_everywhere({sphere(0.5, 0.25, 0, 0.5), cube});
  EXPECT_NEAR(inside.separation, -1, 1e-6);
  EXPECT_EQ(inside.normal, Vector3f(-1, 0, 0));
}

TEST(Hulls, CornerOverFace) {
  const PlacedShape ground = placed_hull(box_corners({5, 5, 1}), {0, 0, -1});
  Points tip = pyramid(-1);
  for (const double gap : {1.0, 0.25, 0x1p-20, 0.0, -0x1p-20, -0.25}) {
    const auto result = checked_everywhere({placed_hull(tip, {0.25, 0.5, 1 + gap}), ground});
    EXPECT_NEAR(result.separation, gap, 2e-6);
    EXPECT_LE((result.normal - Vector3f(0, 0, -1)).norm(), 1e-6f);
    EXPECT_EQ(result.overlap, gap <= 0);
    EXPECT_EQ(result.manifold_count, gap <= 0 ? 1 : 0);
  }
}

// The upper and lower edges of these tetrahedra cross at right angles.
TEST(Hulls, CrossedEdges) {
  const Points lower = {{-1, 0, 0}, {1, 0, 0}, {0, -1, -2}, {0, 1, -2}};
  const Points upper = {{0, -1, 0}, {0, 1, 0}, {-1, 0, 2}, {1, 0, 2}};
  for (const double gap : {1.0, 0.25, 0.0, -0.25}) {
    const auto result =
        checked_everywhere({placed_hull(lower), placed_hull(upper, {0.5, 0.25, gap})});
    EXPECT_NEAR(result.separation, gap, 2e-6);
    EXPECT_LE((result.normal - Vector3f(0, 0, 1)).norm(), 1e-6f);
    EXPECT_EQ(result.overlap, gap <= 0);
    EXPECT_LE((result.arm_a - Vector3f(0.5, 0, 0)).norm(), 2e-6f);
  }
}

// Coordinates are multiples of a quarter, so that nothing rounds: an exact touch at any feature is
// an overlap.
TEST(Hulls, ExactTouch) {
  const Points cube = cube_corners(),
               roof = {{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {1, 1, 0}, {-1, 0, 1}, {1, 0, 1}};
  for (const Vector3d& way :
       {Vector3d(2, 0, 0), {2, 0.5, 0.25}, {2, 2, 0.5}, {2, 2, 2}, {-2, 2, -2}, {0, 0, -2}}) {
    const auto result = checked_everywhere({placed_hull(cube), placed_hull(cube, way)});
    EXPECT_EQ(result.separation, 0) << way.transpose();
    EXPECT_TRUE(result.overlap);
  }
  for (const Vector3d& at : {Vector3d(0, 0, 2), {0.5, 0.5, 2}, {1.75, 0, 2}, {2, 1, 2}}) {
    const auto result = checked_everywhere({placed_hull(roof), placed_hull(cube, at)});
    EXPECT_EQ(result.separation, 0) << at.transpose();
    EXPECT_TRUE(result.overlap);
    const auto apart = checked_everywhere({placed_hull(roof), placed_hull(cube, at * 1.125)});
    EXPECT_FALSE(apart.overlap);
  }
}

// --- Hulls in the form of other shapes ---

TEST(Hulls, OfBoxesAreBoxes) {
  for (const ShapeKind kind : kConvexKinds) {
    const KindPair kinds{ShapeKind::box, kind};
    for (const ConvexFamily& family : convex_families()) {
      std::vector<TestPair> pairs = make_kind_pairs(family, kinds, kFloat32, 4);
      vary_triangles(pairs);
      for (TestPair& pair : pairs) {
        const ShownIfFailed shown([&] { return std::string(family.name) + "\n" + show(pair); });
        const Result expected = reference_result(pair, kFloat32);
        pair.a.shape = hull_of(box_corners(std::get<Box>(pair.a.shape).half));
        expect_close(pair, expected, reference_result(pair, kFloat32));
      }
      if (HasFailure()) return;
    }
  }
}

TEST(Hulls, OfTwoPointsAreSegments) {
  for (const ShapeKind kind : kConvexKinds) {
    for (const ConvexFamily& family : convex_families()) {
      std::vector<TestPair> pairs =
          make_kind_pairs(family, {ShapeKind::capsule, kind}, kFloat32, 4);
      vary_triangles(pairs);
      for (TestPair& pair : pairs) {
        auto& capsule = std::get<Capsule>(pair.a.shape);
        capsule.radius = 0;
        const ShownIfFailed shown([&] { return std::string(family.name) + "\n" + show(pair); });
        const Result expected = reference_result(pair, kFloat32);
        pair.a.shape = hull_of({capsule.a, capsule.b});
        expect_close(pair, expected, reference_result(pair, kFloat32));
      }
      if (HasFailure()) return;
    }
  }
}

TEST(Hulls, OfThreePointsAreTriangles) {
  for (const ShapeKind kind : kConvexKinds) {
    // The second triangle may be one-sided or have inner edges.
    if (kind == ShapeKind::triangle) continue;
    for (const ConvexFamily& family : convex_families()) {
      for (TestPair& pair : make_kind_pairs(family, {ShapeKind::triangle, kind}, kFloat32, 4)) {
        auto& triangle = std::get<Triangle>(pair.a.shape);
        triangle.thickness = 0;
        const ShownIfFailed shown([&] { return std::string(family.name) + "\n" + show(pair); });
        const Result expected = reference_result(pair, kFloat32);
        pair.a.shape = hull_of({triangle.corners.begin(), triangle.corners.end()});
        expect_close(pair, expected, reference_result(pair, kFloat32));
      }
      if (HasFailure()) return;
    }
  }
}

// --- Degenerate hulls ---

TEST(Hulls, WithoutVolume) {
  const std::vector<Points> flat = {
      {{0, 0, 0}},                                                   // a point
      {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}},                             // the same point three times
      {{-1, 0, 0}, {1, 0, 0}},                                       // a segment
      {{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0.5f, 0, 0}, {1, 0, 0}},   // a segment with five points
      {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 0}},   // a square
      {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}},                          // a triangle
      {{0, -1, -1}, {0, 1, -1}, {0, 2, 0}, {0, 1, 1}, {0, -1, 1}}};  // a pentagon
  for (const Points& a : flat) {
    for (const Points& b : flat) {
      for (const Vector3d& at : {Vector3d(0, 0, 0), {1, 0, 0}, {0.5, 0.25, 0}, {2.5, 0, 0.25}}) {
        checked_everywhere({placed_hull(a), placed_hull(b, at)});
        checked_everywhere({placed_hull(a), placed_hull(b, at, Quaternionf(1, 0, 0, 1))});
      }
      checked_everywhere({placed_hull(a), placed_hull(b, {0, 0, 0}, turn(1e-7f, {1, 2, 3}))});
    }
    checked_everywhere({placed_hull(a), placed_hull(cube_corners(), {0.5, 0.25, 0})});
    checked_everywhere({placed_hull(a), placed_hull(cube_corners(), {2, 0, 0})});
  }
}

TEST(Hulls, PointsInsideAndTwiceDoNoHarm) {
  Random random(5);
  for (int round = 0; round < 40; ++round) {
    Points a = round_points(8, {1, 0.5f, 2}, random);
    const PlacedShape b =
        placed_hull(round_points(8, {1, 1, 1}, random), {random.uniform(0, 3), 0, 0});
    const TestPair pair{placed_hull(a), b};
    const Result expected = checked_everywhere(pair);
    for (size_t i = 0; i < 8; ++i) {
      a.push_back(a[i]);
      a.push_back((a[i] + a[i / 2] + a[(i + 3) % 8]) / 3);
    }
    expect_close(pair, expected, checked_everywhere({placed_hull(a), b}));
  }
}

// Points that would be on an edge or in a face without rounding.
TEST(Hulls, SliversAndNearlyFlatOnes) {
  Random random(6);
  for (int round = 0; round < 60; ++round) {
    const auto thin = [&] {
      const Vector3d u = random.direction(), v = random.direction() * (round % 2);
      Points points;
      for (int i = 0; i < 7; ++i) {
        const Vector3d p = u * random.uniform(-1, 1) + v * random.uniform(-1, 1);
        points.push_back(p.cast<float>());
      }
      return placed_hull(points, random.direction() * random.uniform(0, 0.7));
    };
    checked_everywhere({thin(), thin()});
  }
}

// --- Depth ---

TEST(Hulls, InOnePlaceAndPose) {
  Random random(7);
  for (const size_t count : {4, 6, 8, 12, 20}) {
    const PlacedShape hull = placed_hull(round_points(count, {1, 1, 1}, random));
    const Result result = checked_everywhere({hull, hull});
    EXPECT_LT(result.separation, 0);
    EXPECT_EQ(result.status, Status::ok);
    PlacedShape turned = hull;
    turned.orientation = turn(1e-4f, {3, 2, 1});
    checked_everywhere({hull, turned});
  }
  const auto cubes = checked_everywhere({placed_hull(cube_corners()), placed_hull(cube_corners())});
  EXPECT_NEAR(cubes.separation, -2, 2e-6);
}

TEST(Hulls, DepthDoesNotDependOnTheSizeOfASlab) {
  for (const float s : {1.0f, 10.0f, 100.0f, 1000.0f}) {
    for (const float depth : {1e-5f, 1e-3f, 0.1f}) {
      const auto result = checked_everywhere(
          {placed_hull(box_corners({s, s, 0.25f})),
           placed_hull(cube_corners(0.125f), {0.3, 0.2, 0.375 - depth}, turn(0.4f, {0, 0, 1}))});
      EXPECT_NEAR(result.separation, -depth, 1e-6);
      EXPECT_LE((result.normal - Vector3f(0, 0, 1)).norm(), 1e-6f);
    }
  }
}

// A small hull sinks through a large one: the depth follows, and the normal is that of a face.
TEST(Hulls, SinkingThrough) {
  const PlacedShape slab = placed_hull(box_corners({4, 4, 1}));
  for (double z = 1.4; z >= -1.4; z -= 0.0625) {
    const auto result =
        checked_everywhere({slab, placed_hull(cube_corners(0.25f), {0.5, -0.75, z})});
    EXPECT_NEAR(result.separation, std::fabs(z) - 1.25, 2e-6) << z;
    if (z != 0) {
      EXPECT_NEAR(result.normal.z(), z > 0 ? 1 : -1, 1e-6);
    }
  }
}

// --- Manifolds ---

TEST(Hulls, CubeOnCubeHasFourPointsAtTheRim) {
  const auto result = checked_everywhere(
      {placed_hull(box_corners({2, 2, 1})), placed_hull(cube_corners(0.5f), {0.25, 0.5, 1.49})});
  EXPECT_NEAR(result.separation, -0.01, 2e-6);
  EXPECT_EQ(result.normal, Vector3f(0, 0, 1));
  ASSERT_EQ(result.manifold_count, 4);
  for (size_t i = 0; i < 4; ++i) {
    const auto& p = result.manifold.point[i];
    EXPECT_NEAR(std::fabs(p[0] - 0.25f), 0.5, 1e-5);
    EXPECT_NEAR(std::fabs(p[1] - 0.5f), 0.5, 1e-5);
    EXPECT_NEAR(result.manifold.separation[i], -0.01, 2e-6);
  }
}

// The contact area has up to 32 corners, of which the manifold keeps four.
TEST(Hulls, PrismOnPrism) {
  for (const size_t sides : {3, 5, 8, 16}) {
    for (const float angle : {0.0f, 0.1f, 0.5f}) {
      const auto result = checked_everywhere(
          {placed_hull(prism(sides, 1, 0.5f)),
           placed_hull(prism(sides, 1, 0.5f), {0.1, 0, 0.99}, turn(angle, {0, 0, 1}))});
      EXPECT_NEAR(result.separation, -0.01, 2e-6);
      const bool is_triangle = sides == 3 && angle == 0;
      EXPECT_EQ(result.manifold_count, is_triangle ? 3 : 4) << sides << " sides, " << angle;
    }
  }
}

TEST(Hulls, OnAHalfspaceAndOnABox) {
  const PlacedShape cube = placed_hull(cube_corners(0.5f), {5, 6, 0.49});
  for (const PlacedShape& ground :
       {halfspace({0, 0, 0}, {0, 0, 1}, 0), oriented_box({0, 0, -1}, {10, 10, 1}),
        box({0, 0, -1}, {10, 10, 1}), placed_hull(box_corners({10, 10, 1}), {0, 0, -1})}) {
    const auto result = checked_everywhere({cube, ground});
    EXPECT_NEAR(result.separation, -0.01, 1e-5);
    EXPECT_EQ(result.normal, Vector3f(0, 0, -1));
    EXPECT_EQ(result.manifold_count, 4);
  }
}

TEST(Hulls, CapsuleAlongAFace) {
  const auto result = checked_everywhere({capsule({0, 0, 1.4}, {-1, 0.25f, 0}, {1, 0.25f, 0}, 0.5f),
                                          placed_hull(box_corners({2, 2, 1}))});
  EXPECT_NEAR(result.separation, -0.1, 2e-6);
  EXPECT_EQ(result.manifold_count, 2);
}

// No ghost contacts at inner edges (case 64), and none from behind.
TEST(Hulls, OnTrianglesThatHaveRules) {
  Triangle triangle{.corners = {Vector3f(0, -5, 0), Vector3f(9, 0, 0), Vector3f(0, 5, 0)}};
  triangle.inner_edges = 4;
  for (const double x : {-0.2, -0.05, 0.05, 0.2}) {
    const TestPair pair{placed_hull(cube_corners(0.5f), {x, 0, 0.49}), {triangle, {0, 0, 0}}};
    const ShownIfFailed shown([&] { return show(pair); });
    const Result result = reference_result(pair, kFloat32);
    EXPECT_LE((result.normal - Vector3f(0, 0, -1)).norm(), 1e-6f);
    EXPECT_NEAR(result.separation, -0.01, 1e-5);
  }
  triangle.one_sided = true;
  for (const double z : {0.3, -0.3}) {
    const Result result = reference_result(
        {placed_hull(cube_corners(0.5f), {3, 0, z}), {triangle, {0, 0, 0}}}, kFloat32);
    EXPECT_EQ(result.overlap, z > 0);
  }
}

// --- Sizes and places ---

TEST(Hulls, OfAllSizes) {
  Random random(9);
  const Points a = round_points(12, {1, 0.5f, 0.75f}, random);
  const Points b = round_points(9, {1, 1, 0.25f}, random);
  for (double size = 1e-30; size <= 1e18; size *= 1e4) {
    for (const double share : {0.2, 0.9, 1.7}) {
      checked_everywhere(
          {placed_hull(scaled(a, static_cast<float>(size))),
           placed_hull(scaled(b, static_cast<float>(size)), {share * size, 0.3 * size, 0})});
    }
    checked_everywhere({placed_hull(scaled(a, static_cast<float>(size))), placed_hull(b)});
  }
}

TEST(Hulls, SameContactFarFromTheOrigin) {
  Random random(10);
  const Points a = round_points(10, {1, 0.5f, 0.75f}, random);
  for (const Vector3d& way : {Vector3d(0.75, 0.25, 0), {2.5, 0.125, 0.5}}) {
    const Result here =
        checked_everywhere({placed_hull(a), placed_hull(cube_corners(), way)}, kFloat64);
    for (const double distance : {0x1p20, 0x1p30, 0x1p40}) {
      const Vector3d at = Vector3d::Constant(distance);
      const Result there =
          checked_everywhere({placed_hull(a, at), placed_hull(cube_corners(), at + way)}, kFloat64);
      EXPECT_EQ(here.separation, there.separation);
      EXPECT_EQ(here.normal, there.normal);
      EXPECT_EQ(here.arm_a, there.arm_a);
      EXPECT_EQ(here.arm_b, there.arm_b);
    }
  }
}

// Two pyramids far away from each other, on their way to meet at their tips.
TEST(Hulls, C51_PyramidsFarApart) {
  const Points up = pyramid(1), down = pyramid(-1);
  for (const double gap : {1000.0, 998.0, 10.0, 0.5, 0x1p-10, 0.0, -0x1p-10, -0.5}) {
    const auto result = checked_everywhere({placed_hull(up), placed_hull(down, {0, 0, 2 + gap})});
    EXPECT_EQ(result.overlap, gap <= 0);
    if (gap >= 0) {
      EXPECT_NEAR(result.separation, gap, 1e-6 * (1 + gap));
    }
  }
}

// --- Changes that must not matter ---

TEST(Hulls, TheOrderOfPointsDoesNotMatter) {
  for (const ConvexFamily& family : convex_families()) {
    Random random(11);
    for (const TestPair& pair :
         make_kind_pairs(family, {ShapeKind::hull, ShapeKind::hull}, kFloat64, 10)) {
      const ShownIfFailed shown([&] { return std::string(family.name) + "\n" + show(pair); });
      const Result expected = reference_result(pair, kFloat64);
      Points points = points_of(std::get<Hull>(pair.a.shape));
      for (size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[random.below(i)]);
      TestPair other = pair;
      other.a.shape = hull_of(points);
      expect_close(pair, expected, reference_result(other, kFloat64));
    }
    if (HasFailure()) return;
  }
}

// Hulls of up to 64 corners, near touch and deep inside each other.
TEST(Hulls, OfManyCorners) {
  Random random(12);
  for (const size_t count : {16, 32, 64}) {
    for (uint32_t round = 0; round < 320 / count; ++round) {
      const Points a = round_points(count, {1, 1, 1}, random);
      const Points b = round_points(count, {1, 0.5f, 0.25f}, random);
      const Vector3d way = random.direction() * random.uniform(0, 2);
      checked_everywhere({placed_hull(a), placed_hull(b, way, turn(1.3f, {1, 2, 3}))});
      if (HasFailure()) return;
    }
  }
}

// All corners of a fine sphere are about equally far along any direction.
TEST(Hulls, InsideASphereOfTheirSize) {
  Random random(13);
  for (const size_t count : {8, 32, 64}) {
    const Points points = round_points(count, {1, 1, 1}, random);
    for (int round = 0; round < 10; ++round) {
      const Vector3d at = random.direction() * random.uniform(0, 2.5);
      checked_everywhere({placed_hull(points), sphere(at.x(), at.y(), at.z(), 1)});
    }
  }
}

TEST(Hulls, WithoutGeometryAreInvalid) {
  const Result result = reference_result({{Hull{}, {0, 0, 0}}, sphere(0, 0, 0, 1)}, kFloat32);
  EXPECT_EQ(result.status, Status::invalid);
  EXPECT_FALSE(result.overlap);
}

}  // namespace
}  // namespace carom::test
