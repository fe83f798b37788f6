// Geometries of k-DOPs in a world: found once for equal shapes, and again when slabs change.
#include "world/store/dop_geometries.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "carom/world/world.h"
#include "shapes/dop_geometry.h"
#include "tests/world/crowds.h"

namespace carom::test {
namespace {

// Without a geometry.
Dop bare_dop(oracle::Random& random) {
  Dop dop = std::get<Dop>(random_shape(ShapeKind::dop, random));
  dop.geometry = nullptr;
  return dop;
}

TEST(DopGeometries, AreOneForEqualShapes) {
  oracle::Random random(81);
  DopGeometries geometries;
  const Dop dop = bare_dop(random), other = bare_dop(random);
  const auto geometry = geometries.find(dop);
  EXPECT_EQ(geometries.find(dop), geometry);
  EXPECT_NE(geometries.find(other), geometry);
  Dop owner = other;
  owner.geometry = dop_geometry(other);
  EXPECT_EQ(geometries.find(owner), owner.geometry);
  Dop invalid = dop;
  std::swap(invalid.lower, invalid.upper);
  EXPECT_EQ(geometries.find(invalid), nullptr);
}

TEST(DopGeometries, ThatNobodyKeepsAreForgotten) {
  oracle::Random random(82);
  DopGeometries geometries;
  const auto kept = geometries.find(bare_dop(random));
  for (int i = 0; i < 1000; ++i) geometries.find(bare_dop(random));
  EXPECT_EQ(geometries.bytes(), kept->bytes());
  EXPECT_LE(geometries.known(), 32u);
}

// A body's shape has the geometry of its slabs, whether they were set or written.
TEST(DopGeometries, FollowTheSlabsOfABody) {
  oracle::Random random(83);
  const Dop dop = bare_dop(random), other = bare_dop(random);
  World world;
  const BodyId id = world.add({.shape = dop}), equal = world.add({.shape = dop});
  const auto geometry = [&](BodyId body) { return std::get<Dop>(world.shape(body)).geometry; };
  ASSERT_TRUE(geometry(id));
  EXPECT_EQ(geometry(id), geometry(equal));
  world.set_shape(id, other);
  EXPECT_TRUE(geometry(id)->is_of(other));
  EXPECT_TRUE(geometry(equal)->is_of(dop));

  const auto rows = shape_rows(dop);
  std::copy_n(rows[0].data(), 4 * row_count(ShapeKind::dop),
              world.shape_rows().rows + 4 * world.first_row(id));
  EXPECT_FALSE(geometry(id));
  world.step();
  EXPECT_EQ(geometry(id), geometry(equal));
  world.set_shape(id, Sphere{1});
  world.set_shape(id, dop);
  EXPECT_EQ(geometry(id), geometry(equal));
}

// A geometry may outlive the world that found it.
TEST(DopGeometries, BelongToTheShape) {
  oracle::Random random(84);
  Shape shape;
  {
    World world;
    const BodyId id = world.add({.shape = bare_dop(random)});
    shape = world.shape(id);
    world.remove(id);
    world.step();
  }
  EXPECT_TRUE(known_geometry(std::get<Dop>(shape)));
}

}  // namespace
}  // namespace carom::test
