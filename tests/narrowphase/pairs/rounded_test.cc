// Boxes and hulls with a rounding: answers that are known, the kinds of bodies with and without
// one, and rules of triangles that depend on it. Other tests compare them with the reference on
// every ISA, and the reference with an oracle.
#include <gtest/gtest.h>

#include "oracle/hull_faces.h"
#include "tests/support/isas.h"
#include "tests/support/kind_pairs.h"
#include "tests/support/run.h"
#include "tests/support/special_floats.h"

namespace carom::test {
namespace {

Hull cube(float half, float rounding) {
  std::vector<Eigen::Vector3f> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back(i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half);
  }
  Hull hull = oracle::hull_of(corners);
  hull.rounding = rounding;
  return hull;
}

Box box(float half, float rounding) { return {Eigen::Vector3f::Constant(half), rounding}; }

reference::PairResult answer(const Shape& a, const Shape& b, const Eigen::Vector3d& at) {
  return reference_result({{a, {0, 0, 0}}, {b, at}}, PositionType::float64);
}

TEST(Rounded, KindsFollowTheRounding) {
  EXPECT_EQ(kind_of(box(1, 0)), ShapeKind::box);
  EXPECT_EQ(kind_of(box(1, -0.0f)), ShapeKind::box);
  EXPECT_EQ(kind_of(box(1, 0.5f)), ShapeKind::rounded_box);
  EXPECT_EQ(kind_of(box(1, kNan)), ShapeKind::rounded_box);
  EXPECT_EQ(kind_of(cube(1, 0)), ShapeKind::hull);
  EXPECT_EQ(kind_of(cube(1, 0.5f)), ShapeKind::rounded_hull);
  EXPECT_EQ(kind_of(Cylinder{1, 1, 0.5f}), ShapeKind::cylinder);
  EXPECT_STREQ(name(ShapeKind::rounded_box), "rounded_box");
  EXPECT_STREQ(name(ShapeKind::rounded_hull), "rounded_hull");
}

TEST(Rounded, RowsKeepTheRounding) {
  const Hull hull = cube(1, 0.25f);
  for (const Shape& shape : {Shape(box(1, 0.25f)), Shape(hull), Shape(Cylinder{1, 2, 0.25f}),
                             Shape(Cone{1, 2, 0.25f}), Shape(Ellipsoid{{1, 2, 3}, 0.25f})}) {
    const auto rows = shape_rows(shape);
    EXPECT_EQ(rows[0][3], 0.25f);
    const Shape again = shape_from_rows(kind_of(shape), rows.data());
    EXPECT_EQ(kind_of(again), kind_of(shape));
    EXPECT_EQ(shape_rows(again), rows);
  }
}

// Two cubes of side 2, both grown by 1/4, of which every form is one. They meet face to face, edge
// to edge and corner to corner.
TEST(Rounded, SeparationsAreThoseOfTheCoresLessTheRoundings) {
  const Shape forms[] = {box(1, 0.25f), cube(1, 0.25f)};
  struct {
    Eigen::Vector3d at;
    double separation;
  } const kCases[] = {{{3, 0, 0}, 0.5},
                      {{2.25, 0, 0}, -0.25},
                      {{1.5, 0, 0}, -1},
                      {{5, 6, 0}, 4.5},
                      {{2.2, 2.1, 0}, std::hypot(0.2, 0.1) - 0.5},
                      {{4, 4, 3}, 2.5},
                      {{2.2, 2.2, 2.1}, -0.2}};
  for (const Shape& a : forms) {
    for (const Shape& b : forms) {
      for (const auto& [at, separation] : kCases) {
        const auto found = answer(a, b, at);
        EXPECT_NEAR(found.separation, separation, 1e-6) << at.transpose();
        EXPECT_EQ(found.overlap, separation <= 0) << at.transpose();
        EXPECT_NEAR((found.arm_b.cast<double>() + at - found.arm_a.cast<double>())
                        .dot(found.normal.cast<double>()),
                    separation, 1e-5);
      }
    }
  }
}

TEST(Rounded, ManifoldsAreThoseOfTheCores) {
  const auto rounded = answer(box(1, 0.25f), box(1, 0.125f), {0.5, 0.25, 2.25});
  const auto cores = answer(box(1, 0), box(1, 0), {0.5, 0.25, 1.875});
  ASSERT_EQ(rounded.manifold_count, 4u);
  ASSERT_EQ(cores.manifold_count, 4u);
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(rounded.manifold.separation[i], -0.125, 1e-6);
    EXPECT_NEAR(rounded.manifold.point[i][0], cores.manifold.point[i][0], 1e-6);
    EXPECT_NEAR(rounded.manifold.point[i][1], cores.manifold.point[i][1], 1e-6);
    EXPECT_NEAR(rounded.manifold.point[i][2], 1.25, 1e-6);
  }
}

// Views may say that bodies are rounded, and then give no rounding.
TEST(Rounded, WithoutRoundingAnswersAreThoseOfPlainKinds) {
  for (const KindPair& kinds :
       {KindPair{ShapeKind::box, ShapeKind::box}, KindPair{ShapeKind::hull, ShapeKind::hull},
        KindPair{ShapeKind::sphere, ShapeKind::box}, KindPair{ShapeKind::hull, ShapeKind::triangle},
        KindPair{ShapeKind::box, ShapeKind::hull}, KindPair{ShapeKind::capsule, ShapeKind::hull}}) {
    SCOPED_TRACE(name(kinds));
    for (const ConvexFamily& family : convex_families()) {
      const auto pairs = make_kind_pairs(family, kinds, PositionType::float32, 50);
      for_each_isa([&] {
        const LaidOut a(side_a(pairs), {}), b(side_b(pairs), {});
        Collidables view_a = a.view(), view_b = b.view();
        Columns plain(pairs.size()), rounded(pairs.size());
        for (const Detail detail : {Detail::overlap, Detail::contact, Detail::manifold}) {
          ASSERT_TRUE(collide_rows(view_a, view_b, detail, plain.out()));
          const std::vector<Row> expected = plain.rows();
          const auto round = [](ShapeKind kind) {
            return kind == ShapeKind::box    ? ShapeKind::rounded_box
                   : kind == ShapeKind::hull ? ShapeKind::rounded_hull
                                             : kind;
          };
          view_a.uniform_kind = round(kinds.a);
          view_b.uniform_kind = round(kinds.b);
          ASSERT_TRUE(collide_rows(view_a, view_b, detail, rounded.out()));
          EXPECT_TRUE(same_rows(expected, rounded.rows(), pairs)) << family.name;
          view_a.uniform_kind = kinds.a;
          view_b.uniform_kind = kinds.b;
        }
      });
      if (HasFailure()) return;
    }
  }
}

// The cores are in front of the triangle and do not touch it, but the rounded shapes do.
TEST(Rounded, TrianglesKeepTheirRules) {
  Triangle triangle{{Eigen::Vector3f(-4, -4, 0), {4, -4, 0}, {0, 4, 0}}, 0, true, 7};
  for (const Shape& shape :
       {Shape(box(1, 0.5f)), Shape(cube(1, 0.5f)), Shape(Cylinder{1, 1, 0.5f})}) {
    const auto above = answer(shape, triangle, {0, 0, -1.25});
    EXPECT_TRUE(above.overlap);
    EXPECT_NEAR(above.separation, -0.25, 1e-6);
    EXPECT_NEAR(above.normal.z(), -1, 1e-6);
    EXPECT_FALSE(answer(shape, triangle, {0, 0, 1.25}).overlap) << "from behind";
    // Beyond the edge: pushed along the face's normal, not over the inner edge.
    const auto beyond = answer(shape, triangle, {0, 5.25, -1.25});
    EXPECT_TRUE(beyond.overlap);
    EXPECT_NEAR(beyond.normal.z(), -1, 1e-6);
  }
}

TEST(Rounded, SmallRoundingsCount) {
  for (const float rounding : {1e-4f, 1e-6f, 1e-9f, 1e-30f}) {
    const auto touching = answer(box(1, rounding), box(1, rounding), {2, 0, 0});
    EXPECT_TRUE(touching.overlap);
    EXPECT_EQ(touching.separation, -2 * rounding);
    const double apart = 2 + 2.5 * double{rounding};
    if (rounding < 1e-14f) continue;
    EXPECT_FALSE(answer(box(1, rounding), box(1, rounding), {apart, 0, 0}).overlap) << rounding;
    EXPECT_TRUE(
        answer(box(1, rounding), box(1, rounding), {2 + 1.5 * double{rounding}, 0, 0}).overlap)
        << rounding;
  }
}

// The cores are 5 apart, and the roundings reach that far exactly, or not by the last bit.
TEST(Rounded, TheExactTierDecidesThem) {
  for (const float last : {3.0f, std::nextafter(3.0f, 0.0f)}) {
    std::vector<TestPair> pairs;
    for (const Shape& a : {Shape(box(1, 2)), Shape(cube(1, 2))}) {
      for (const Shape& b : {Shape(box(1, last)), Shape(cube(1, last)), Shape(Sphere{last})}) {
        const double half = std::holds_alternative<Sphere>(b) ? 0 : 1;
        pairs.push_back({{a, {0, 0, 0}}, {b, {4 + half, 0, 5 + half}}});
      }
    }
    for_each_isa([&] {
      Call call = call_with(PositionType::float64);
      call.accuracy.tier = Tier::exact;
      for (const Row& row : run_rows(pairs, call)) EXPECT_EQ(row.overlap, last == 3 ? 1 : 0);
      call.accuracy.tier = Tier::certified;
      for (const Row& row : run_rows(pairs, call)) {
        EXPECT_TRUE(row.overlap == kUndecided || row.overlap == (last == 3 ? 1 : 0));
      }
    });
  }
}

}  // namespace
}  // namespace carom::test
