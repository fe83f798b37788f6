// k-DOPs as shapes: pairs with known answers, and k-DOPs in the form of boxes, which answer as
// boxes do.
#include <gtest/gtest.h>

#include <cfloat>

#include "tests/support/checked_everywhere.h"
#include "tests/support/kind_pairs.h"

namespace carom::test {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;
using Result = reference::PairResult;

constexpr DopKind kDopKinds[] = {DopKind::k6, DopKind::k14, DopKind::k18, DopKind::k26};

PlacedShape placed(const Dop& dop, const Eigen::Vector3d& position,
                   const Quaternionf& orientation = Quaternionf::Identity()) {
  return {dop, position, orientation};
}

// All points with
// x
// +
// y
// +
// z
// <= reach; the axis slabs are wider.
Dop octahedron(float reach) {
  Dop dop{.kind = DopKind::k14};
  for (size_t i = 0; i < slab_count(dop.kind); ++i) {
    dop.upper[i] = i < 3 ? FLT_MAX : reach;
    dop.lower[i] = -dop.upper[i];
  }
  return dop;
}

Dop dop_of_box(const Vector3f& lower, const Vector3f& upper, DopKind kind) {
  std::vector<Vector3f> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back((i & 1 ? upper : lower).x(), (i & 2 ? upper : lower).y(),
                         (i & 4 ? upper : lower).z());
  }
  return Dop::of_points(corners, kind);
}

TEST(Dops, SphereAgainstFaceEdgeAndCorner) {
  const float third = std::sqrt(1.0f / 3);
  const auto corner = checked_everywhere({sphere(0, 0, 3, 0.5), placed(octahedron(2), {0, 0, 0})});
  EXPECT_NEAR(corner.separation, 0.5, 1e-6);
  EXPECT_EQ(corner.normal, Vector3f(0, 0, -1));
  EXPECT_EQ(corner.arm_b, Vector3f(0, 0, 2));
  const auto edge = checked_everywhere({sphere(2, 2, 0, 0.5), placed(octahedron(2), {0, 0, 0})});
  EXPECT_NEAR(edge.separation, std::sqrt(2.0) - 0.5, 1e-6);
  EXPECT_NEAR(edge.normal.x(), -std::sqrt(0.5), 1e-6);
  EXPECT_EQ(edge.normal.z(), 0);
  const auto face = checked_everywhere({sphere(1, 1, 1, 0.5), placed(octahedron(2), {0, 0, 0})});
  EXPECT_NEAR(face.separation, third - 0.5, 1e-6);
  EXPECT_NEAR(face.normal.x(), -third, 1e-6);
  const auto inside = checked_everywhere({sphere(0, 0, 0, 0.5), placed(octahedron(2), {0, 0, 0})});
  EXPECT_NEAR(inside.separation, -2 * third - 0.5, 1e-6);
  EXPECT_EQ(inside.status, Status::ok);
}

TEST(Dops, CornersEdgesAndFacesOfTwo) {
  const Dop dop = octahedron(1);
  EXPECT_NEAR(checked_everywhere({placed(dop, {0, 0, 0}), placed(dop, {0, 0, 2.25})}).separation,
              0.25, 1e-6);
  const auto edges = checked_everywhere({placed(dop, {0, 0, 0}), placed(dop, {1.25, 1.25, 0})});
  EXPECT_NEAR(edges.separation, 0.25 * std::sqrt(2.0), 1e-6);
  const auto faces = checked_everywhere({placed(dop, {0, 0, 0}), placed(dop, {0.5, 0.5, 0.5})});
  EXPECT_NEAR(faces.separation, (1.5 - 2) / std::sqrt(3.0), 1e-6);
  EXPECT_GE(faces.manifold_count, 3);
}

// Crossed edges of two shapes that are turned against each other.
TEST(Dops, CrossedEdges) {
  const Dop dop = dop_of_box({-1, -1, -1}, {1, 1, 1}, DopKind::k18);
  const float s = std::sin(0.39269908f), c = std::cos(0.39269908f);  // an eighth of a turn
  const Quaternionf a(c, s, 0, 0), b(c, 0, s, 0);
  const double reach = std::sqrt(2.0);
  for (const double gap : {0.5, 1e-3, -1e-3, -0.1}) {
    const auto result =
        checked_everywhere({placed(dop, {0, 0, 0}, a), placed(dop, {0, 0, 2 * reach + gap}, b)});
    EXPECT_NEAR(result.separation, gap, 2e-6);
    EXPECT_NEAR(result.normal.z(), 1, 1e-6);
  }
}

TEST(Dops, OnAHalfspace) {
  const PlacedShape ground = halfspace({0, 0, 0}, {0, 0, 1}, 0);
  const Dop cube = dop_of_box({-1, -1, -1}, {1, 1, 1}, DopKind::k26);
  const auto lying = checked_everywhere({placed(cube, {5, 6, 0.75}), ground});
  EXPECT_NEAR(lying.separation, -0.25, 1e-6);
  EXPECT_EQ(lying.normal, Vector3f(0, 0, -1));
  EXPECT_EQ(lying.manifold_count, 4);
  const auto standing = checked_everywhere({placed(octahedron(1), {5, 6, 1.5}), ground});
  EXPECT_NEAR(standing.separation, 0.5, 1e-6);
}

// A stack: the contact area is an octagon, of which the manifold keeps four points.
TEST(Dops, FaceOnFace) {
  Dop dop{.kind = DopKind::k26};
  for (size_t i = 0; i < 13; ++i) {
    dop.upper[i] = i < 3 ? 1.0f : i < 7 ? 2.2f : 1.5f;
    dop.lower[i] = -dop.upper[i];
  }
  for (const float angle : {0.0f, 0.1f, 0.5f}) {
    const Quaternionf turned(Eigen::AngleAxisf(angle, Vector3f::UnitZ()));
    const auto result =
        checked_everywhere({placed(dop, {0, 0, 0}), placed(dop, {0.1, 0, 1.99}, turned)});
    EXPECT_NEAR(result.separation, -0.01, 2e-6);
    EXPECT_EQ(result.normal, Vector3f(0, 0, 1));
    ASSERT_EQ(result.manifold_count, 4);
    for (size_t i = 0; i < 4; ++i) {
      const auto& p = result.manifold.point[i];
      EXPECT_GE(std::hypot(p[0] - 0.05f, p[1]), 0.4f) << "spread";
    }
  }
}

TEST(Dops, CapsuleAlongAFace) {
  const Dop dop = dop_of_box({-2, -2, -1}, {2, 2, 1}, DopKind::k26);
  const auto result = checked_everywhere(
      {capsule({0, 0, 1.4}, {-1, 0.25f, 0}, {1, 0.25f, 0}, 0.5f), placed(dop, {0, 0, 0})});
  EXPECT_NEAR(result.separation, -0.1, 1e-6);
  EXPECT_EQ(result.manifold_count, 2);
}

// Flat, thin and single-point k-DOPs that touch others of their form.
TEST(Dops, WithoutVolume) {
  const std::vector<Dop> flat = {dop_of_box({0, 0, 0}, {0, 0, 0}, DopKind::k26),
                                 dop_of_box({-1, 0, 0}, {1, 0, 0}, DopKind::k14),
                                 dop_of_box({-1, -1, 0}, {1, 1, 0}, DopKind::k18),
                                 dop_of_box({-1, 0, -1}, {1, 0, 1}, DopKind::k6)};
  for (const Dop& a : flat) {
    for (const Dop& b : flat) {
      for (const Eigen::Vector3d& at : {Eigen::Vector3d(0, 0, 0), {1, 0, 0}, {2.5, 0, 0.25}}) {
        checked_everywhere({placed(a, {0, 0, 0}), placed(b, at)});
        checked_everywhere({placed(a, {0, 0, 0}), placed(b, at, Quaternionf(1, 0, 0, 1))});
      }
    }
  }
}

TEST(Dops, InOnePlaceAndPose) {
  for (const DopKind kind : kDopKinds) {
    const Dop dop = dop_of_box({-1, -2, -3}, {1, 2, 3}, kind);
    const auto result = checked_everywhere({placed(dop, {0, 0, 0}), placed(dop, {0, 0, 0})});
    EXPECT_NEAR(result.separation, -2, 1e-6);
    EXPECT_NEAR(std::fabs(result.normal.x()), 1, 1e-6);
  }
}

// A k-DOP around the corners of a box is that box.
TEST(Dops, AroundBoxesAreBoxes) {
  for (const ShapeKind kind : kConvexKinds) {
    const KindPair kinds{ShapeKind::box, kind};
    for (const ConvexFamily& family : convex_families()) {
      std::vector<TestPair> pairs = make_kind_pairs(family, kinds, kFloat32, 3);
      vary_triangles(pairs);
      for (TestPair& pair : pairs) {
        const ShownIfFailed shown([&] { return std::string(family.name) + "\n" + show(pair); });
        const Result expected = reference_result(pair, kFloat32);
        const Vector3f half = std::get<Box>(pair.a.shape).half;
        const double size = bounding_radius(pair.a.shape) + bounding_radius(pair.b.shape);
        for (const DopKind k : kDopKinds) {
          pair.a.shape = dop_of_box(-half, half, k);
          const Result result = reference_result(pair, kFloat32);
          if (result.separation == expected.separation) continue;  // covers infinite separations
          EXPECT_NEAR(result.separation, expected.separation,
                      4e-6 * (size + std::fabs(expected.separation)) + 0x1p-140);
        }
      }
      if (HasFailure()) return;
    }
  }
}

// A capsule whose ends are so close that the square of its length is a subnormal float: its
// direction is mostly rounding, and must not count.
TEST(Dops, AroundACapsuleWithoutLength) {
  const Dop cube = dop_of_box({-1, -1, -1}, {1, 1, 1}, DopKind::k6);
  Random random(7);
  for (const float length : {0.0f, 2.7e-23f, 3e-23f, 1e-22f, 1e-20f, 1e-12f, 1e-8f}) {
    for (int round = 0; round < 40; ++round) {
      const Vector3f way = random.direction().cast<float>();
      const Eigen::AngleAxisd turn(random.uniform(0, 3), random.direction());
      const PlacedShape inside{Capsule{{0, 0, 0}, way * length, 0.25f},
                               random.uniform(0, 0.9) * random.direction()};
      const auto result = checked_everywhere(
          {inside, placed(cube, {0, 0, 0}, Eigen::Quaterniond(turn).cast<float>())});
      EXPECT_LT(result.separation, -0.25f);
    }
  }
}

}  // namespace
}  // namespace carom::test
