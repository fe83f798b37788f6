// Geometries that are kept with k-DOPs.
#include "shapes/dop_geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "oracle/random.h"
#include "tests/support/float_modes.h"

namespace carom::test {
namespace {

Dop random_dop(oracle::Random& random, DopKind kind = DopKind::k26) {
  std::vector<Eigen::Vector3f> points(12);
  for (auto& p : points) p = random.direction().cast<float>();
  return Dop::of_points(points, kind);
}

TEST(DopGeometry, HasThePolytopeOfTheSlabs) {
  oracle::Random random(71);
  for (const DopKind kind : {DopKind::k6, DopKind::k14, DopKind::k18, DopKind::k26}) {
    const Dop dop = random_dop(random, kind);
    const auto geometry = dop_geometry(dop);
    ASSERT_TRUE(geometry);
    const DopPolytope polytope{DopSlabs(dop)};
    ASSERT_EQ(geometry->polytope().point_count(), polytope.point_count());
    for (size_t i = 0; i < polytope.point_count(); ++i) {
      EXPECT_EQ(geometry->polytope().point(i), polytope.point(i));
    }
    EXPECT_EQ(geometry->size(), DopSlabs(dop).with_tight_axes().size());
    EXPECT_LT(geometry->bytes(), 10'240u);
  }
}

// The hull has the corners of the polytope, rounded, and all faces with an area; the rounding
// leaves a closed solid.
TEST(DopGeometry, HasTheHullOfTheCorners) {
  oracle::Random random(74);
  for (const DopKind kind : {DopKind::k6, DopKind::k14, DopKind::k18, DopKind::k26}) {
    for (int round = 0; round < 50; ++round) {
      const auto geometry = dop_geometry(random_dop(random, kind));
      const DopPolytope& polytope = geometry->polytope();
      const HullGeometry& hull = *geometry->hull();
      ASSERT_EQ(hull.points().size(), polytope.point_count());
      for (size_t i = 0; i < polytope.point_count(); ++i) {
        for (size_t axis = 0; axis < 3; ++axis) {
          EXPECT_EQ(hull.points()[i][static_cast<int>(axis)],
                    static_cast<float>(polytope.point(i)[axis]));
        }
      }
      EXPECT_LE(hull.faces().size(), polytope.faces().size());
      EXPECT_TRUE(hull.features());
    }
  }
}

TEST(DopGeometry, OfAFlatDopHasAHullWithoutFeatures) {
  Dop flat{.kind = DopKind::k6};
  for (size_t i = 0; i < 3; ++i) flat.upper[i] = i == 2 ? 0.0f : 1.0f;
  const Hull hull = hull_of(flat);
  EXPECT_EQ(hull.geometry->points().size(), 4u);
  EXPECT_EQ(hull.geometry->size(), 1.0f);
  EXPECT_FALSE(hull.geometry->features());
}

// The rounding mode of the caller changes neither the slabs nor the corners.
TEST(DopGeometry, IsTheSameInAnyFloatMode) {
  oracle::Random random(73);
  size_t different_points = 0;
  for (int round = 0; round < 20; ++round) {
    std::vector<Eigen::Vector3f> points(12);
    for (auto& p : points) p = random.direction().cast<float>();
    const Dop dop = Dop::of_points(points, DopKind::k26);
    const auto geometry = dop_geometry(dop);
    for (const FloatMode& mode : float_modes()) {
      SCOPED_TRACE(mode.name);
      const ScopedFloatMode scoped(mode);
      const Dop again = Dop::of_points(points, DopKind::k26);
      EXPECT_EQ(again.lower, dop.lower);
      EXPECT_EQ(again.upper, dop.upper);
      const auto other = dop_geometry(dop);
      ASSERT_EQ(other->polytope().point_count(), geometry->polytope().point_count());
      for (size_t i = 0; i < geometry->polytope().point_count(); ++i) {
        EXPECT_EQ(other->polytope().point(i), geometry->polytope().point(i));
      }
      // The polytope alone sets no mode, which shows that the modes matter.
      const DopPolytope unguarded{DopSlabs(dop)};
      for (size_t i = 0; i < unguarded.point_count(); ++i) {
        different_points += unguarded.point(i) != geometry->polytope().point(i);
      }
    }
  }
#if defined(__SSE2__)
  EXPECT_GT(different_points, 100u);
#endif
}

TEST(DopGeometry, OfInvalidSlabsIsNone) {
  Dop dop{.kind = DopKind::k14};
  dop.lower[4] = 1;
  EXPECT_FALSE(dop_geometry(dop));
  dop.upper[4] = INFINITY;
  EXPECT_FALSE(dop_geometry(dop));
  EXPECT_FALSE(dop_geometry(Dop{.kind = static_cast<DopKind>(7)}));
}

TEST(DopGeometry, CountsOnlyForItsOwnSlabs) {
  oracle::Random random(72);
  Dop dop = random_dop(random);
  EXPECT_EQ(known_geometry(dop), nullptr);
  dop.geometry = dop_geometry(dop);
  EXPECT_EQ(known_geometry(dop), dop.geometry.get());
  EXPECT_EQ(dop_geometry(dop), dop.geometry);
  for (float* end : {&dop.lower[0], &dop.upper[0], &dop.lower[12], &dop.upper[12]}) {
    const float before = *end;
    *end = std::nextafter(before, 0.0f);
    EXPECT_EQ(known_geometry(dop), nullptr);
    EXPECT_NE(dop_geometry(dop), dop.geometry);
    *end = before;
  }
  dop.kind = DopKind::k18;
  EXPECT_EQ(known_geometry(dop), nullptr);
}

// A view may name the geometry of slabs that the body had before.
TEST(DopGeometry, IsReadWithTheBody) {
  oracle::Random random(73);
  const Dop dop = random_dop(random), other = random_dop(random);
  const auto geometry = dop_geometry(dop);
  const DopGeometry* const dops[] = {geometry.get(), geometry.get(), nullptr};
  std::vector<std::array<float, 4>> rows;
  for (const Dop& each : {dop, other, dop}) {
    const auto all = shape_rows(each);
    rows.insert(rows.end(), all.begin(), all.begin() + row_count(ShapeKind::dop));
  }
  Collidables view;
  view.count = 3;
  view.uniform_kind = ShapeKind::dop;
  view.rows.data = rows[0].data();
  view.dops = dops;
  const BodyReader reader{view};
  EXPECT_EQ(read_dop(reader, 0).geometry.get(), geometry.get());
  EXPECT_EQ(read_dop(reader, 1).geometry, nullptr);
  EXPECT_EQ(read_dop(reader, 1).lower, other.lower);
  EXPECT_EQ(read_dop(reader, 2).geometry, nullptr);
  EXPECT_EQ(read_dop(reader, 2).upper, dop.upper);
}

}  // namespace
}  // namespace carom::test
