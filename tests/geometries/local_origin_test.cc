#include "geometries/local_origin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "carom/reference/reference.h"
#include "carom/shapes/hull.h"
#include "carom/shapes/mesh_geometry.h"

namespace carom::test {
namespace {

using Float3 = std::array<float, 3>;

Part ball(float radius) {
  Part part;
  part.radius = radius;
  return part;
}

Float3 origin_at(const Double3& place, const Part& part) {
  return origin_near(kNotTurned, {}, part, place);
}

TEST(LocalOrigin, IsZeroWhereItGainsNothing) {
  const Float3 zero{};
  EXPECT_EQ(origin_at({0.5, 0, 0}, ball(1)), zero);
  EXPECT_EQ(origin_at({1e4, 0, 0}, ball(1e5f)), zero);
  EXPECT_EQ(origin_at({0, 0, 0}, ball(0)), zero);
  EXPECT_EQ(origin_at({NAN, 0, 0}, ball(1)), zero);
  EXPECT_EQ(origin_at({INFINITY, 0, 0}, ball(1)), zero);
  EXPECT_EQ(origin_at({1e300, 0, 0}, ball(1)), zero);
  Part plane;
  plane.kind = ShapeKind::halfspace;
  plane.rows[0] = {0, 0, 1, 0};
  EXPECT_EQ(origin_at({1000, 0, 0}, plane), zero);
}

TEST(LocalOrigin, IsNearInFewDigits) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(-1, 1), exponent(-12, 12);
  size_t moved = 0;
  for (int i = 0; i < 10000; ++i) {
    const double reach = std::exp2(exponent(random));
    const auto radius = static_cast<float>(std::exp2(exponent(random)) * 0.01);
    const Double3 place = {reach * share(random), reach * share(random), reach * share(random)};
    const Float3 origin = origin_at(place, ball(radius));
    if (origin == Float3{}) continue;
    ++moved;
    const double step = std::max(4.0 * radius, 0x1p-16 * greatest(place));
    for (size_t axis = 0; axis < 3; ++axis) {
      EXPECT_LE(std::fabs(place[axis] - origin[axis]), step / 2);
      // Numbers of at most 18 bits.
      int unused;
      const float digits = std::frexp(origin[axis], &unused) * 0x1p18f;
      EXPECT_EQ(digits, std::nearbyint(digits));
    }
  }
  EXPECT_GT(moved, 5000u);
}

TEST(LocalOrigin, IsInTheFrameOfTheMesh) {
  const float half = std::sqrt(0.5f);
  const Turn quarter = rotation_of({0, 0, half, half});  // x to y
  const Float3 origin = origin_near(quarter, {100, 0, 0}, ball(1), {100, 64, 0});
  EXPECT_EQ(origin, (Float3{64, 0, 0}));
}

// However far from its mesh's origin a floor of two triangles is: what touches it has the same
// contact. The numbers are such that all are exact.
TEST(LocalOrigin, ContactsFarOutOnAMeshAreAllAlike) {
  const auto floor_at = [](float x) {
    const std::vector<Eigen::Vector3f> vertices = {
        {x - 2, -2, 0}, {x + 2, -2, 0}, {x + 2, 2, 0}, {x - 2, 2, 0}};
    const std::vector<std::array<uint32_t, 3>> triangles = {{0, 1, 2}, {0, 2, 3}};
    return Mesh{*make_mesh(vertices, triangles)};
  };
  const std::vector<Eigen::Vector3f> corners = {
      {0.5f, 0, -0.5f}, {-0.5f, 0.25f, -0.5f}, {-0.25f, -0.5f, -0.5f}, {0, 0, 0.5f}};
  const std::vector<std::vector<uint32_t>> faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const Hull hull{*make_hull(corners, faces)};
  const auto contact_at = [&](float x) {
    return reference::collide(floor_at(x), Pose{}, hull, Pose{.position = {x + 0.25, 0.125, 0.375}},
                              PositionType::float64);
  };
  const reference::PairResult near = contact_at(16);
  EXPECT_TRUE(near.overlap);
  EXPECT_EQ(near.separation, -0.125f);
  EXPECT_EQ(near.normal, Eigen::Vector3f::UnitZ());
  for (const float x : {64.0f, 1024.0f, 65536.0f}) {
    const reference::PairResult far = contact_at(x);
    EXPECT_EQ(far.separation, near.separation);
    EXPECT_EQ(far.normal, near.normal);
    EXPECT_EQ(far.arm_b, near.arm_b);
    EXPECT_EQ(far.arm_a, near.arm_a + Eigen::Vector3f(x - 16, 0, 0));
  }
}

}  // namespace
}  // namespace carom::test
