// Motions with known answers: inputs that broke other systems, and the ends of the interval.
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

// The time of impact, after checking that every instruction set, both orders and both types of
// positions agree with it.
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

// The time may be below the exact one by rounding and the slack.
void expect_toi(const MovedPair& pair, double exact) {
  const ShownIfFailed shown([&] { return show(pair); });
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

// Case 41: a sphere passes a sliver.
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

// Case 50: resting, moving away, approaching.
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

// Case 51: fast, from far away.
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

// Case 55: a travel of 3.
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

// Case 59: almost parallel to a capsule.
TEST(ImpactCases, PointFallsAlongCapsule) {
  const PlacedShape pillar = capsule({0, 0, 0}, {0, 0, 0}, {0, 10, 0}, 1);
  const double x = 1.0001f;
  EXPECT_LE(toi_everywhere(moved(sphere(x, 100, 0, 0), {-.001f, -200, 0}, pillar)), 1);
}

// For every two kinds: shapes that touch exactly in one point, the origin.
struct Touching {
  PlacedShape low;   // reaches up to z = 0 at x = y = 0
  PlacedShape high;  // reaches down to the same point
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

// Bodies that touch at the start have an impact at 0, wherever they move.
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

// Bodies that touch only at the end of the interval meet.
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

// A half-space that turns about a point of its own plane, like a floor. It was once treated as one
// that does not turn.
TEST(ImpactCases, PlanesThatTurnAboutTheirOwnPointMeet) {
  for (const double away : {10.0, 100.0}) {
    const PlacedShape ball{Sphere{1}, {away, 0, 11}};
    MovedPair pair = moved(ball, {0, 0, 0}, halfspace({0, 0, 0}, {0, 0, 1}, 0), {0, 0, 0});
    pair.sweep_b.rotation = {0, -1.5f, 0};
    // The height over the plane is 11 cos(angle) - away sin(angle); the ball's radius is 1.
    const double angle = std::acos(1 / std::hypot(11, away)) - std::atan2(away, 11);
    EXPECT_NEAR(toi_everywhere(pair), angle / 1.5, 1e-6);
  }
}

PlacedShape dop(DopKind kind, std::initializer_list<float> lower,
                std::initializer_list<float> upper, const Eigen::Vector3d& at,
                const Eigen::Quaternionf& orientation) {
  Dop dop;
  dop.kind = kind;
  std::copy(lower.begin(), lower.end(), dop.lower.begin());
  std::copy(upper.begin(), upper.end(), dop.upper.begin());
  return {dop, at, orientation};
}

// Corners of k-DOPs may lie 1e-8 apart. GJK once took a tetrahedron with two such corners for one
// that contains the origin.
TEST(ImpactCases, CornersThatAlmostCoincide) {
  const MovedPair pairs[] = {
      moved(dop(DopKind::k14,
                {-0x1.c93ffp-1f, -0x1.eb0fd6p-2f, -0x1.365cc8p-2f, -0x1.acfb2p+0f, -0x1.0a8ffcp+0f,
                 -0x1.11ccbcp+0f, -0x1.3013c4p+0f},
                {0x1.56630cp+0f, 0x1.7dc396p-1f, 0x1.23565p-2f, 0x1.12b32ap+0f, 0x1.809ffp+0f,
                 0x1.2c2628p+0f, 0x1.9a12eep+0f},
                {0x0p+0, -0x0p+0, 0x0p+0},
                {0x1.f2dd18p-1f, -0x1.588a82p-3f, -0x1.efddf2p-4f, -0x1.675cccp-4f}),
            {-0x1.6eaa62p-18f, 0x1.919892p-17f, -0x1.2c9p-15f},
            PlacedShape{Box{{0x1.c2ec18p-2f, 0x1.789906p-1f, 0x1.138f5ep+0f}},
                        {-0x1.0a6e92p+1, -0x1.134f96p+0, -0x1.419b88p-1},
                        {0x1.c98104p-5f, -0x1.0dd482p-1f, 0x1.04d9d4p-3f, -0x1.ad42eep-1f}},
            {0x1.95dea6p-14f, -0x1.fc0ab4p-16f, -0x1.244bc4p-15f}),
      moved(dop(DopKind::k14,
                {-0x1.586c36p-2f, -0x1.22242p-1f, -0x1.08bbd4p-1f, -0x1.4d0048p+0f, -0x1.9fc69ep-2f,
                 -0x1.4cef54p-1f, -0x1.724cc2p-1f},
                {0x1.d5d6c6p-2f, 0x1.45c654p-1f, 0x1.acfde6p-2f, 0x1.5bf05ep+0f, 0x1.e1310cp-1f,
                 0x1.a982bp-1f, 0x1.6a85fcp-1f},
                {0x0p+0, -0x0p+0, -0x0p+0},
                {0x1.b6d52cp-2f, -0x1.f9237ep-3f, 0x1.817e16p-1f, -0x1.bcbd26p-2f}),
            {0x1.01c7f6p+0f, -0x1.3d17d6p+0f, 0x1.221206p+1f},
            PlacedShape{Box{{0x1.d50288p-2f, 0x1.698fc2p-2f, 0x1.01ed32p-2f}},
                        {0x1.9cda37f2c7adcp-1, -0x1.3e6059b83296dp-2, 0x1.096c3639b1984p+1},
                        {0x1.71253ap-3f, 0x1.fc771ep-2f, -0x1.486a3cp-1f, 0x1.1cd848p-1f}},
            {-0x1.9e2798p+0f, 0x1.3f7924p-2f, 0x1.5e6bfap-2f}),
      moved(PlacedShape{Box{{0x1.4cd754p-1f, 0x1.8e0cc8p-1f, 0x1.be8ae8p-1f}},
                        {-0x0p+0, -0x0p+0, -0x0p+0},
                        {0x1.8d8ec2p-1f, 0x1.008c76p-6f, -0x1.6df34p-2f, -0x1.099bb8p-1f}},
            {-0x0p+0f, 0x0p+0f, 0x0p+0f},
            dop(DopKind::k26,
                {-0x1.a6dd76p-1f, -0x1.001118p-2f, -0x1.ee4ff2p-1f, -0x1.054d7cp+1f,
                 -0x1.054d7cp+1f, -0x1.054d7cp+1f, -0x1.054d7cp+1f, -0x1.1373p+0f, -0x1.ca96b4p+0f,
                 -0x1.372c4p+0f, -0x1.1373p+0f, -0x1.ca96b4p+0f, -0x1.372c4p+0f},
                {0x1.a6dd76p-1f, 0x1.001118p-2f, 0x1.ee4ff2p-1f, 0x1.054d7cp+1f, 0x1.054d7cp+1f,
                 0x1.054d7cp+1f, 0x1.054d7cp+1f, 0x1.1373p+0f, 0x1.ca96b4p+0f, 0x1.372c4p+0f,
                 0x1.1373p+0f, 0x1.ca96b4p+0f, 0x1.372c4p+0f},
                {0x1.8682ea2558dcap-1, -0x1.0c5eb50f22ed6p+1, 0x1.8d9ef67e44da9p+1},
                {0x1.8d8ec2p-1f, 0x1.008c7p-6f, -0x1.6df34p-2f, -0x1.099bb8p-1f}),
            {-0x1.70e5d6p+0f, 0x1.3b81e2p+2f, -0x1.cfa962p+0f})};
  for_each_isa([&] {
    for (const MovedPair& pair : pairs) {
      for (const MovedPair& motion : {pair, swapped(pair)}) {
        const Judgement judgement = judge(motion, impact_of(motion).toi);
        EXPECT_EQ(judgement.fault, Fault::none) << name(judgement.fault) << show(motion);
      }
    }
  });
}

// Edges that cross while both turn and hardly approach each other. Along a direction that does not
// turn with them the search crept, and ended 1e-3 of the size too early.
TEST(ImpactCases, EdgesThatCrossWhileTheyTurn) {
  const Box half{{0x1.287ceap-1f, 0x1.94a4aep-2f, 0x1.c10d92p-1f}};
  MovedPair pair = moved({half,
                          {-0x1.84750cp+2, -0x1.e3d3f4p+0, -0x1.61aab8p+0},
                          {0x1.3f5bb8p-1f, -0x1.777814p-1f, -0x1.e8d9dcp-3f, -0x1.04807p-3f}},
                         {0x1.5fe902p-1f, 0x1.8f7d78p-1f, 0x1.0d8792p-5f},
                         {half,
                          {-0x1.26da98p+2, -0x1.1cb104p+0, -0x1.03a15ap+0},
                          {-0x1.dce84cp-1f, 0x1.5a72a8p-3f, -0x1.48cf22p-5f, 0x1.4749b8p-2f}});
  pair.sweep_a.rotation = {-0x1.db6cc2p-5f, 0x1.c73f04p-7f, -0x1.da7b62p-8f};
  pair.sweep_b.rotation = {-0x1.2fe612p-3f, -0x1.a710f6p-1f, 0x1.8f3812p+0f};
  for_each_isa([&] {
    for (const MovedPair& motion : {pair, swapped(pair)}) {
      const ImpactRow row = impact_of(motion);
      EXPECT_EQ(row.status, static_cast<uint32_t>(Status::ok));
      EXPECT_NEAR(row.toi, 0.467821754, 1e-7);
      EXPECT_EQ(judge(motion, row.toi).fault, Fault::none);
    }
  });
}

// A box passes a k-DOP of the same orientation, but for a unit in the last place. The distance of
// their edges, which are nearly parallel, was off by 4.6e-9: that of a plane through a triangle
// that is nearly a line.
TEST(ImpactCases, EdgesThatAreParallelButForRounding) {
  Dop dop = Dop::of_points(std::vector<Vector3f>{{0x1.76cedap-2f, -0x1.48ec1p+0f, -0x1.2774cep-3f},
                                                 {0x1.eb0b7cp-1f, 0x1.d08b38p-3f, 0x1.c0028ap-2f}},
                           DopKind::k6);
  MovedPair pair =
      moved({dop, {0, 0, 0}, {0x1.bc9a76p-3f, -0x1.b331ap-4f, -0x1.4a981cp-1f, -0x1.72dc5ap-1f}},
            {0x1.59a2fp-4f, -0x1.3059cap-6f, 0x1.78596p-5f},
            {Box{{0x1.ef381p-2f, 0x1.9480e4p-2f, 0x1.2ebf3ep-1f}},
             {-0x1.04149ff27c3bep-4, 0x1.0997ed2817321p+0, 0x1.88c96a0197f8bp-2},
             {0x1.bc9a76p-3f, -0x1.b3319ep-4f, -0x1.4a981cp-1f, -0x1.72dc5ap-1f}},
            {0x1.9f003ep-3f, -0x1.3b70dp-5f, -0x1.5ee354p-3f});
  for_each_isa([&] {
    for (const MovedPair& motion : {pair, swapped(pair)}) {
      const ImpactRow row = impact_of(motion);
      EXPECT_EQ(row.status, static_cast<uint32_t>(Status::ok));
      const Judgement found = judge(motion, row.toi);
      EXPECT_EQ(found.fault, Fault::none) << row.toi << ": " << found.separation;
    }
  });
}

// One-sided triangles that turn together, so that one meets the other's back with its face:
// rounding says whether it comes from behind. Whatever it says, the contact says the same: its
// numbers are finite if there is an impact.
TEST(ImpactCases, TrianglesFaceToBack) {
  const Shape shape = Triangle{.corners = {{{0.5f, 0, 0}, {-1, -1, 0}, {-1, 0.5f, 0}}},
                               .thickness = 0.1f,
                               .one_sided = true};
  struct Input {
    Eigen::Vector3d place;
    Vector3f way, turn;
  };
  const Input inputs[] = {{{0.5, -1.5, -0.5}, {0, 0, 0}, {-5, 5, -15}},
                          {{1.5, 0.5, -0.5}, {0, -1.5f, 2}, {10, -10, 5}}};
  for (const Input& input : inputs) {
    MovedPair pair = moved({shape, {0, 0, 0}}, {0, 0, 0}, {shape, input.place}, input.way);
    pair.sweep_a.rotation = pair.sweep_b.rotation = input.turn;
    for (const MovedPair& motion : {pair, swapped(pair)}) {
      const ImpactRow row = impact_of(motion);
      const ShownIfFailed shown([&] { return show(motion) + show(row); });
      EXPECT_EQ(row.is_impact(), std::isfinite(row.separation));
      EXPECT_EQ(row.is_impact(), std::isfinite(row.normal[0]));
    }
  }
}

// Two children of a compound touch at the same time: the result is of the lower one, whichever the
// search finds first.
TEST(ImpactCases, TheLowestOfChildrenThatMeetAtOnce) {
  const Shape corner = hull_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  const auto children = *make_compound(std::vector<CompoundChild>{
      {.shape = corner, .position = {1, 0, 0}}, {.shape = corner, .position = {0, 1, 0}}});
  const PlacedShape flat{hull_of({{-5, -5, 0}, {5, -5, 0}, {0, 5, 0}}), {0, 0, 5}};
  const MovedPair of_hulls = moved({Compound{children}, {0, 0, 0}}, {0, 0, 0}, flat, {1, 0, -6});

  const Shape cube =
      Dop::of_points(std::vector<Vector3f>{{-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}}, DopKind::k6);
  const auto cubes = *make_compound(std::vector<CompoundChild>{
      {.shape = cube, .position = {-2, 1, 0}}, {.shape = cube, .position = {-2, -1, 0}}});
  const PlacedShape above{flat.shape, {0, 0, 2}};
  const MovedPair of_dops =
      moved({Compound{cubes}, {0, 0, 0}}, {0, 0, 0}, above, {0, -1, -0x1.eccccep+2f});

  for (const MovedPair& pair : {of_hulls, of_dops}) {
    const ShownIfFailed shown([&] { return show(pair); });
    for_each_isa([&] {
      const ImpactRow row = impact_of(pair);
      EXPECT_TRUE(row.is_impact());
      EXPECT_EQ(row.sub_a, 0u);
      EXPECT_EQ(impact_of(swapped(pair)).sub_b, 0u);
    });
  }
}

}  // namespace
}  // namespace carom::test
