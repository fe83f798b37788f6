// Exact decisions against the oracle in 100 digits, and proofs in double precision against both.
#include "narrowphase/proof/exact_overlap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "carom/results/tier.h"
#include "narrowphase/proof/proof.h"
#include "oracle/exact_oracle.h"
#include "tests/support/kind_pairs.h"
#include "tests/support/rounds.h"
#include "tests/support/show.h"
#include "tests/support/stated.h"

namespace carom::test {
namespace {

// The pair without differences that 100 digits cannot represent: positions moved from zero by the
// smallest doubles.
ConvexPair without_dust(ConvexPair pair) {
  const Eigen::Vector3d way = pair.pose_b.position - pair.pose_a.position;
  const double size = way.cwiseAbs().maxCoeff();
  for (int i = 0; i < 3; ++i) {
    const bool is_dust = std::fabs(way[i]) < 1e-60 * size || std::fabs(way[i]) < 1e-60;
    if (is_dust) pair.pose_b.position[i] = pair.pose_a.position[i];
  }
  return pair;
}

ConvexPair as_stored(ConvexPair pair, PositionType positions) {
  for (Pose* pose : {&pair.pose_a, &pair.pose_b})
    pose->position = stored(pose->position, positions);
  return without_dust(pair);
}

class ExactOverlap : public testing::TestWithParam<ConvexFamily> {};

TEST_P(ExactOverlap, IsWhatTheOracleSays) {
  size_t overlaps = 0, undecided = 0, count = 0;
  uint64_t seed = 100;
  for (const KindPair& kinds : solved_kind_pairs()) {
    for (const PositionType positions : kPositionTypes) {
      ConvexPairMaker maker(GetParam(), kinds, positions, ++seed);
      for (size_t i = 0; i < fewer_if_slow(kinds, rounds(32)); ++i) {
        const ConvexPair pair = as_stored(maker.next(), positions);
        const ShownIfFailed shown(
            [&] { return std::string(name(kinds)) + "\n" + show(as_test_pair(pair)); });
        const StatedBody a = stated_body(pair.shape_a, pair.pose_a);
        const StatedBody b = stated_body(pair.shape_b, pair.pose_b);
        const bool overlap = exact_gap(pair).is_overlap();
        ASSERT_EQ(exact_overlap(a, b), overlap);
        const uint8_t proven = prove_overlap(a, b);
        ASSERT_TRUE(proven == kUndecided || proven == overlap) << int{proven};
        ++count;
        overlaps += overlap;
        undecided += proven == kUndecided;
      }
    }
  }
  RecordProperty("overlapping", std::to_string(overlaps));
  RecordProperty("undecided", std::to_string(undecided));
  if (GetParam().name == std::string("plain")) {
    EXPECT_GT(overlaps, count * 3 / 10);
    EXPECT_LT(overlaps, count * 7 / 10);
    EXPECT_EQ(undecided, 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(Families, ExactOverlap, testing::ValuesIn(convex_families()), family_name);

StatedBody at(const Shape& shape, double x, double y, double z,
              const Eigen::Quaternionf& q = Eigen::Quaternionf::Identity()) {
  return stated_body(shape, Pose{{x, y, z}, q});
}

// The decision, after checking that both orders agree.
bool overlap(const StatedBody& a, const StatedBody& b) {
  EXPECT_EQ(exact_overlap(a, b), exact_overlap(b, a));
  return exact_overlap(a, b);
}

TEST(ExactOverlap, ToTheSmallestDouble) {
  const double step = 0x1p-1074;
  EXPECT_TRUE(overlap(at(Sphere{0}, 0, 0, 0), at(Sphere{0}, 0, 0, 0)));
  EXPECT_FALSE(overlap(at(Sphere{0}, 0, 0, 0), at(Sphere{0}, step, 0, 0)));
  const Box cube{{1, 1, 1}};
  EXPECT_TRUE(overlap(at(cube, 0, 0, 0), at(cube, 2, 0, 0)));
  EXPECT_FALSE(overlap(at(cube, 0, 0, 0), at(cube, 2 + 0x1p-51, 0, 0)));
  EXPECT_FALSE(overlap(at(cube, -step, 0, 0), at(cube, 2, 0, 0)));
}

TEST(ExactOverlap, AtTheEndsOfTheRange) {
  const Sphere largest{std::numeric_limits<float>::max()};
  const double most = std::numeric_limits<double>::max();
  EXPECT_FALSE(overlap(at(largest, -most, 0, 0), at(largest, most, 0, 0)));
  EXPECT_TRUE(overlap(at(largest, 0, 0, 0), at(largest, double{largest.radius} * 2, 0, 0)));
  const Sphere smallest{std::numeric_limits<float>::denorm_min()};
  EXPECT_TRUE(overlap(at(smallest, 0, 0, 0), at(smallest, 0x1p-148, 0, 0)));
  EXPECT_FALSE(overlap(at(smallest, 0, 0, 0), at(smallest, 0x1p-148 + 0x1p-200, 0, 0)));
}

// The front's normal is (1, 2, 2) / 3, so no number is irrational.
constexpr double kThird = 1.0 / 3;

Triangle slanted(float thickness, bool one_sided = false) {
  Triangle triangle;
  triangle.corners = {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(-20, 10, 0),
                      Eigen::Vector3f(-20, 0, 10)};
  triangle.thickness = thickness;
  triangle.one_sided = one_sided;
  return triangle;
}

// The back is offset by -thickness (1, 2, 2) / 3: by (-1, -2, -2) for a thickness of 3.
TEST(ExactOverlap, ThickTrianglesReachAsFarAsTheirThickness) {
  const Sphere point{0};
  EXPECT_TRUE(overlap(at(slanted(3), 0, 0, 0), at(point, -1, -2, -2)));
  EXPECT_FALSE(overlap(at(slanted(3), 0, 0, 0), at(point, -1, -2, -2 - 0x1p-50)));
  EXPECT_FALSE(overlap(at(slanted(std::nextafter(3.0f, 0.0f)), 0, 0, 0), at(point, -1, -2, -2)));
  EXPECT_TRUE(overlap(at(slanted(std::nextafter(3.0f, 4.0f)), 0, 0, 0), at(point, -1, -2, -2)));
  // The two backs touch when the other triangle is moved by six thirds of the normal.
  Triangle other = slanted(3);
  std::swap(other.corners[1], other.corners[2]);
  EXPECT_TRUE(overlap(at(slanted(3), 0, 0, 0), at(other, -2, -4, -4)));
  EXPECT_FALSE(overlap(at(slanted(3), 0, 0, 0), at(other, -2, -4, -4 - 0x1p-49)));
}

// A normal with a root: (0, 1, 1) / sqrt(2). Then two thick triangles with different roots.
TEST(ExactOverlap, RootsAreExact) {
  Triangle a;
  a.corners = {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(0, -8, 8), Eigen::Vector3f(-8, 0, 0)};
  a.thickness = 1;
  const bool looks_up = (a.corners[1] - a.corners[0]).cross(a.corners[2] - a.corners[0]).y() > 0;
  if (!looks_up) std::swap(a.corners[1], a.corners[2]);
  // The back is offset by (0, -1, -1) / sqrt(2).
  const double root = std::sqrt(0.5);
  const double below = std::nextafter(root, 0.0), above = std::nextafter(root, 1.0);
  const double inside = below * below * 2 < 1 ? below : 0.7;
  EXPECT_TRUE(overlap(at(a, 0, 0, 0), at(Sphere{0}, -0.25, -inside, -inside)));
  EXPECT_FALSE(overlap(at(a, 0, 0, 0), at(Sphere{0}, -0.25, -above, -above)));
  // The other triangle is sqrt(1/3) thick along each axis.
  Triangle b;
  b.corners = {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(8, -8, 0), Eigen::Vector3f(8, 0, -8)};
  b.thickness = 1;
  for (const double shift : {0.0, 0.25, 0.5, 1.0, 2.0}) {
    const StatedBody moved = at(b, 0, -shift, -shift);
    EXPECT_EQ(overlap(at(a, 0, 0, 0), moved), overlap(moved, at(a, 0, 0, 0))) << shift;
  }
}

TEST(ExactOverlap, WhatComesFromBehindIsApart) {
  const Sphere ball{4};
  const auto moved = [&](double along) {
    return at(ball, -13 + along * kThird, 3 + 2 * along * kThird, 3 + 2 * along * kThird);
  };
  EXPECT_TRUE(overlap(at(slanted(0, true), 0, 0, 0), moved(3)));
  EXPECT_FALSE(overlap(at(slanted(0, true), 0, 0, 0), moved(-3)));
  EXPECT_TRUE(overlap(at(slanted(0), 0, 0, 0), moved(-3)));
  // A ball in the plane of the back, which a thickness of 3 offsets by (-1, -2, -2), and a ball
  // behind it.
  EXPECT_TRUE(overlap(at(slanted(3, true), 0, 0, 0), at(ball, -1, -2, -2)));
  EXPECT_FALSE(overlap(at(slanted(3, true), 0, 0, 0), at(ball, -1, -2, -2 - 0x1p-50)));
  // A triangle without area has no front.
  Triangle line = slanted(3, true);
  line.corners[2] = line.corners[1] * 2;
  EXPECT_TRUE(overlap(at(line, 0, 0, 0), at(ball, -1, -2, -2)));
}

// k-DOPs whose rounded slabs have no point in common count as half a unit wider.
TEST(ExactOverlap, DopsOfOnePoint) {
  const Eigen::Vector3f point(0.1f, 0.7f, -0.3f);
  for (const DopKind kind : {DopKind::k6, DopKind::k14, DopKind::k18, DopKind::k26}) {
    const Dop dop = Dop::of_points({&point, 1}, kind);
    const auto ball = [&](double x) {
      return at(Sphere{0x1p-20f}, x, double{0.7f}, double{-0.3f});
    };
    EXPECT_TRUE(overlap(at(dop, 0, 0, 0), ball(double{0.1f})));
    EXPECT_FALSE(overlap(at(dop, 0, 0, 0), ball(double{0.1f} + 0x1p-18)));
  }
}

// The two parts of a + b sqrt(s) cancelled. Their remainder in doubles chose a wrong corner.
TEST(ExactOverlap, PointJustInsideTheBackOfAThickTriangle) {
  Triangle triangle;
  triangle.corners = {Eigen::Vector3f(-0x1.00b9eap-2f, -0x1.d2cdfep-2f, -0x1.cef342p-4f),
                      Eigen::Vector3f(0x1.0e2882p-2f, -0x1.e8ea1cp-6f, 0x1.a1d174p-1f),
                      Eigen::Vector3f(0x1.1bdacp-2f, 0x1.4a79d2p-3f, -0x1.471022p-6f)};
  triangle.thickness = 0x1.5d2464p-1f;
  EXPECT_TRUE(overlap(at(triangle, 0, 0, 0), at(Sphere{0}, 0x1.917c4214c183bp-1,
                                                -0x1.d8519d23a60d1p-2, 0x1.738ff43c593cbp-1)));
}

// A k-DOP of the axis slabs and the slab of (1, 1, 1); the other slabs are so wide that they do not
// matter.
Dop cut_box(const Eigen::Vector3f& lower, const Eigen::Vector3f& upper, float cut_lower,
            float cut_upper) {
  Dop dop{.kind = DopKind::k14};
  const float wide = 3 * cut_upper;
  for (size_t i = 0; i < slab_count(dop.kind); ++i) {
    const auto& d = slab_directions(dop.kind)[i];
    const bool is_axis = i < 3, is_cut = d[0] == 1 && d[1] == 1 && d[2] == 1;
    dop.lower[i] = is_axis ? lower[static_cast<int>(i)] : is_cut ? cut_lower : -wide;
    dop.upper[i] = is_axis ? upper[static_cast<int>(i)] : is_cut ? cut_upper : wide;
  }
  return dop;
}

// The slabs miss each other by less than rounding can tell. Their ends are zero, so widening them
// has no effect.
TEST(ExactOverlap, DopsThatAreAllButEmpty) {
  const StatedBody dop = at(cut_box({-1, -1, -1}, {0, 0, 0}, 1e-20f, 3), 0, 0, 0);
  EXPECT_TRUE(overlap(dop, at(Sphere{0}, 0, 0, 0)));
  EXPECT_FALSE(overlap(dop, at(Sphere{0}, 0, 0, 0x1p-20)));
  EXPECT_EQ(prove_overlap(dop, at(Sphere{0}, 0, 0, 0)), kUndecided);
}

TEST(ExactOverlap, ProofsLeaveAllButEmptyDopsAlone) {
  const StatedBody dop = at(cut_box({-8, -8, -8}, {1, 1, -2}, 1e-20f, 24), 0, 0, 0);
  for (const double above : {1e-8, 1e-7, 1.1e-7, 1.3e-7}) {
    const StatedBody point = at(Sphere{0}, 1, 1, -2 + above);
    EXPECT_EQ(overlap(dop, point), above < 1.2e-7);
    EXPECT_EQ(prove_overlap(dop, point), kUndecided);
  }
}

TEST(ExactOverlap, SmallDopsFarAway) {
  const Eigen::Vector3f point(-0x1.ed111cp-73f, 0, 0x1.adbf76p-71f);
  const StatedBody dop = at(Dop::of_points({&point, 1}, DopKind::k26), 0, 0, 0);
  const StatedBody ball = at(Sphere{1}, 0, 0, 1.7e308);
  EXPECT_FALSE(overlap(dop, ball));
  EXPECT_NE(prove_overlap(dop, ball), 1);
}

// The two are too far apart for scaled units.
TEST(ExactOverlap, HalfspacesAtTheEndOfTheRange) {
  const Halfspace halfspace{{0x1.ff933cp+127f, 0x1.4484cp-100f, 0x1.b7cdfep-34f}, 0x1.93e594p+99f};
  const Aabb box{{0x1.b38fb8p-127f, -0x1p+0f, -0x1.c363ccp+127f},
                 {0x1.99999ap-4f, -0x1.99999ap-4f, -0x1.79ca1p-67f}};
  const StatedBody a =
      at(halfspace, -0x1.e42d130773b76p+1023, 0x1.7e43c8800759cp+996, -0x1.99999ap-4,
         Eigen::Quaternionf(0x1.ff933cp+127f, 0x1.93e594p+99f, -0x1.ff933cp+127f, 0x1.b7cdfep-34f));
  const StatedBody b = at(box, 0x1.ff933cp+127, -0x1.b7cdfep-34, -0x1.99999ap-4);
  EXPECT_FALSE(overlap(a, b));
  EXPECT_NE(prove_overlap(a, b), 1);
}

}  // namespace
}  // namespace carom::test
