// Motions with known answers: what broke other systems, and what happens at the ends.
#include <gtest/gtest.h>

#include "oracle/hull_faces.h"
#include "tests/support/impacts.h"

namespace carom::test {
namespace {

using Eigen::Vector3f;

MovedPair moved(const PlacedShape& a, const Vector3f& by_a, const PlacedShape& b,
                const Vector3f& by_b = Vector3f::Zero()) {
  MovedPair pair{{a, b}, {}, {}};
  pair.sweep_a.displacement = by_a;
  pair.sweep_b.displacement = by_b;
  return pair;
}

// Of the pair, on every instruction set, both ways round and with both types of positions.
float toi_everywhere(const MovedPair& pair) {
  const float toi = impact_of(pair).toi;
  for_each_isa([&] {
    for (const PositionType positions : kPositionTypes) {
      EXPECT_EQ(impact_of(pair, positions).toi, toi);
      EXPECT_EQ(impact_of(swapped(pair), positions).toi, toi);
    }
  });
  const Judgement judgement = judge(pair, toi);
  EXPECT_EQ(judgement.fault, Fault::none) << name(judgement.fault);
  return toi;
}

// As far below the true one as rounding and the slack allow.
void expect_toi(const MovedPair& pair, double exact) {
  SCOPED_TRACE(show(pair));
  const float toi = toi_everywhere(pair);
  EXPECT_LE(toi, exact);
  EXPECT_NEAR(toi, exact, 1e-7);
}

PlacedShape point_capsule(const Eigen::Vector3d& at, float radius) {
  return capsule(at, Vector3f::Zero(), Vector3f::Zero(), radius);
}

PlacedShape pyramid(const Eigen::Vector3d& at) {
  const std::vector<Vector3f> points = {{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {0, 0, 2}};
  return {hull_of(points), at};
}

// Case 41: past a sliver.
TEST(ImpactCases, SpherePassesSliver) {
  const PlacedShape ball = sphere(14.831459, 8.1905508, -4.30825043, 0.2f);
  const PlacedShape sliver =
      triangle({0, 0, 0}, {Vector3f(14.5536213f, 10.5973721f, -.0060005188f),
                           Vector3f(14.5536213f, 10.5969315f, -3.18638134f),
                           Vector3f(14.5536213f, 10.5969315f, -5.18637228f)});
  MovedPair pair = moved(ball, {-.0988006592f, 5.96e-8f, 7.32e-4f}, sliver);
  pair.bodies.a.position = pair.bodies.a.position.cast<float>().cast<double>();
  EXPECT_EQ(toi_everywhere(pair), kNever);
}

// Case 48: a capsule of no length is a sphere.
TEST(ImpactCases, CapsuleWithoutLength) {
  const PlacedShape ball = sphere(0, 0, 0, 1), capsule = point_capsule({0, 0, 0}, 1);
  for (const PlacedShape& target : {ball, capsule}) {
    MovedPair pair = moved(point_capsule({-4, 0, 0}, 0), {8, 0, 0}, target);
    expect_toi(pair, 0.375);
    pair.bodies.a = sphere(-4, 0, 0, 0);
    expect_toi(pair, 0.375);
  }
}

// Case 49: a subnormal displacement ends without a hit.
TEST(ImpactCases, SubnormalDisplacement) {
  const PlacedShape far =
      triangle({0, 50, 0}, {Vector3f(-1, 0, -1), Vector3f(1, 0, -1), Vector3f(0, 0, 1)});
  EXPECT_EQ(toi_everywhere(moved(sphere(0, 0, 0, 0.375f), {0, 6.925e-39f, 0}, far)), kNever);
}

// Case 50: still, away, towards.
TEST(ImpactCases, CubesBesideEachOther) {
  for (const bool is_turning_kind : {false, true}) {
    const Vector3f half(0.5f, 0.5f, 0.5f);
    const auto cube = [&](double x) {
      return is_turning_kind ? oriented_box({x, 0, 0}, half) : box({x, 0, 0}, half);
    };
    const float x = 1.1f;
    EXPECT_EQ(toi_everywhere(moved(cube(0), {0, 0, 0}, cube(x))), kNever);
    EXPECT_EQ(toi_everywhere(moved(cube(0), {-1, 0, 0}, cube(x))), kNever);
    expect_toi(moved(cube(0), {1, 0, 0}, cube(x)), double{x} - 1);
  }
}

// Case 51: fast, from far.
TEST(ImpactCases, PyramidsFromFar) {
  expect_toi(moved(pyramid({0, 0, 0}), {0, 0, 1e5f}, pyramid({0, 0, 1000})), 998 / 1e5);
}

// Case 52: the error does not grow with the box.
TEST(ImpactCases, SphereFallsOnBoxesOfAllSizes) {
  const float radius = 0.5166f;
  for (const float half : {5.0f, 50.0f, 500.0f}) {
    const MovedPair pair = moved(sphere(0.25, double{half} + 8, 0.25, radius), {0, -16, 0},
                                 oriented_box({0, 0, 0}, {half, half, half}));
    expect_toi(pair, (8 - double{radius}) / 16);
  }
}

// Case 55: 3 of travel.
TEST(ImpactCases, CubeFallsOnCube) {
  for (const float travel : {4.0f, 10.0f, 1000.0f}) {
    const Vector3f half(1, 1, 1);
    const Vector3f down(0, -travel, 0);
    expect_toi(moved(box({0, 10, 0}, half), {0, 0, 0}, box({0, 15, 0}, half), down), 3 / travel);
    expect_toi(
        moved(oriented_box({0, 10, 0}, half), {0, 0, 0}, oriented_box({0, 15, 0}, half), down),
        3 / travel);
  }
}

// Case 59: nearly along a capsule.
TEST(ImpactCases, PointFallsAlongCapsule) {
  const PlacedShape pillar = capsule({0, 0, 0}, {0, 0, 0}, {0, 10, 0}, 1);
  const double x = 1.0001f;
  EXPECT_LE(toi_everywhere(moved(sphere(x, 100, 0, 0), {-.001f, -200, 0}, pillar)), 1);
}

// Shapes of every two kinds that touch at one point, exactly, all about the origin.
struct Touching {
  PlacedShape low;   // reaches up to z = 0 at x = y = 0
  PlacedShape high;  // reaches down to it
};

PlacedShape touching(ShapeKind kind, double side) {
  const auto height = static_cast<float>(side);
  const std::vector<Vector3f> corners = {
      {1, 1, height}, {-1, 1, height}, {-1, -1, height}, {1, -1, height}, {0, 0, 0}};
  switch (kind) {
    case ShapeKind::sphere:
      return sphere(0, 0, side, 1);
    case ShapeKind::capsule:
      return capsule({0, 0, 0}, {0, 0, height}, {0, 0, 3 * height}, 1);
    case ShapeKind::aabb:
      return box({0, 0, side}, {1, 1, 1});
    case ShapeKind::box:
      return oriented_box({0, 0, side}, {1, 1, 1});
    case ShapeKind::dop:
      return {Dop::of_points(corners, DopKind::k14), {0, 0, 0}};
    case ShapeKind::hull:
      return {hull_of(corners), {0, 0, 0}};
    case ShapeKind::triangle:
      return triangle({0, 0, 0},
                      {Vector3f(0, 0, 0), Vector3f(1, 1, height), Vector3f(-1, 1, height)});
    default:
      return halfspace({0, 0, 0}, {0, 0, -height}, 0);
  }
}

// Touching is an impact at once, wherever they go then.
TEST(ImpactCases, WhatTouchesAtTheStartMeetsAtOnce) {
  for (const KindPair& kinds : convex_kind_pairs()) {
    SCOPED_TRACE(name(kinds));
    const PlacedShape low = touching(kinds.a, -1), high = touching(kinds.b, 1);
    for (const Vector3f& way : {Vector3f(0, 0, 0), Vector3f(0, 0, 1), Vector3f(0, 0, -1),
                                Vector3f(1, 0, 0), Vector3f(1e30f, 0, 1e30f)}) {
      EXPECT_EQ(toi_everywhere(moved(low, {0, 0, 0}, high, way)), 0) << way.transpose();
    }
  }
}

// What touches at the very end meets.
TEST(ImpactCases, WhatTouchesAtTheEndMeets) {
  for (const KindPair& kinds : convex_kind_pairs()) {
    SCOPED_TRACE(name(kinds));
    PlacedShape high = touching(kinds.b, 1);
    high.position.z() += 4;
    const float toi = toi_everywhere(moved(touching(kinds.a, -1), {0, 0, 0}, high, {0, 0, -4}));
    EXPECT_LE(toi, 1);
    EXPECT_NEAR(toi, 1, 1e-6);
  }
}

// A half-space that turns about a point of its own plane, as floors do (it was taken for one that
// does not turn).
TEST(ImpactCases, PlanesThatTurnAboutTheirOwnPointMeet) {
  for (const double away : {10.0, 100.0}) {
    const PlacedShape ball{Sphere{1}, {away, 0, 11}};
    MovedPair pair = moved(ball, {0, 0, 0}, halfspace({0, 0, 0}, {0, 0, 1}, 0), {0, 0, 0});
    pair.sweep_b.rotation = {0, -1.5f, 0};
    // The height over the plane is 11 cos(angle) - away sin(angle), and the ball's radius 1.
    const double angle = std::acos(1 / std::hypot(11, away)) - std::atan2(away, 11);
    EXPECT_NEAR(toi_everywhere(pair), angle / 1.5, 1e-6);
  }
}

}  // namespace
}  // namespace carom::test
