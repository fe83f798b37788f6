// Casts, overlaps and nearest bodies at height fields equal those at meshes of the same triangles.
#include <gtest/gtest.h>

#include "carom/queries/queries.h"
#include "tests/support/cast_checks.h"
#include "tests/support/height_fields.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

struct Surfaces {
  std::vector<PlacedShape> fields, meshes;
};

Surfaces make_surfaces(size_t count, uint64_t seed) {
  Composites shapes(seed);
  Surfaces result;
  for (size_t i = 0; i < count; ++i) {
    const auto nx = static_cast<uint32_t>(2 + shapes.random().below(40));
    const auto ny = static_cast<uint32_t>(2 + shapes.random().below(40));
    const auto field = geometry_of(random_heights(nx, ny, 0.7, i % 2 ? 0.05 : 0, shapes.random()));
    PlacedShape body = {HeightField{field}, Eigen::Vector3d(5, 5, 5),
                        Eigen::Quaternionf::Identity()};
    if (i % 3 != 0) body.orientation = shapes.orientation();
    result.fields.push_back(body);
    body.shape = mesh_like(*field);
    result.meshes.push_back(body);
  }
  return result;
}

std::vector<PlacedShape> make_rays(size_t count, uint64_t seed) {
  oracle::Random random(seed);
  std::vector<PlacedShape> rays;
  for (size_t i = 0; i < count; ++i) {
    rays.push_back({Sphere{0},
                    {random.uniform(-5, 15), random.uniform(-5, 15), random.uniform(-5, 15)},
                    Eigen::Quaternionf::Identity()});
  }
  return rays;
}

void expect_same_casts(const std::vector<PlacedShape>& queries, bool turn, double length) {
  const Surfaces surfaces = make_surfaces(6, 2);
  const Sweeps sweeps = make_sweeps(queries.size(), length, turn, 4);
  for (const PositionType positions : kPositionTypes) {
    const LaidOut a(queries, {.positions = positions});
    const LaidOut fields(surfaces.fields, {.positions = positions});
    const LaidOut meshes(surfaces.meshes, {.positions = positions});
    for_each_isa([&] {
      for (const CastHits which : {CastHits::all, CastHits::closest}) {
        std::vector<CastHit> expected, hits;
        ASSERT_TRUE(bool(cast(a.view(), sweeps.view(), meshes.view(), expected, {.hits = which})));
        ASSERT_TRUE(bool(cast(a.view(), sweeps.view(), fields.view(), hits, {.hits = which})));
        EXPECT_FALSE(expected.empty());
        EXPECT_TRUE(bits_of(hits) == bits_of(expected)) << show(hits, expected);
      }
    });
  }
}

TEST(HeightFieldCasts, OfRays) {
  expect_same_casts(make_rays(rounds(300), 3), false, 15);
  expect_same_casts(make_rays(rounds(100), 4), false, 1000);
}

TEST(HeightFieldCasts, OfBodies) {
  const auto queries = make_bodies({.count = rounds(60), .side = 10}, 5);
  expect_same_casts(queries, false, 8);
  expect_same_casts(queries, true, 8);
}

TEST(HeightFieldCasts, OfHeightFields) {
  const auto others = make_bodies({.count = rounds(60), .side = 10}, 6);
  const Surfaces surfaces = make_surfaces(6, 7);
  const Sweeps sweeps = make_sweeps(surfaces.fields.size(), 5, true, 8);
  const LaidOut fields(surfaces.fields, {}), meshes(surfaces.meshes, {}), b(others, {});
  std::vector<CastHit> expected, hits;
  ASSERT_TRUE(bool(cast(meshes.view(), sweeps.view(), b.view(), expected)));
  ASSERT_TRUE(bool(cast(fields.view(), sweeps.view(), b.view(), hits)));
  EXPECT_TRUE(bits_of(hits) == bits_of(expected)) << show(hits, expected);
}

TEST(HeightFieldQueries, EqualThoseOfMeshes) {
  const auto queries = make_bodies({.count = rounds(100), .side = 10}, 9);
  const Surfaces surfaces = make_surfaces(8, 10);
  const LaidOut a(queries, {}), fields(surfaces.fields, {}), meshes(surfaces.meshes, {});
  std::vector<OverlapHit> expected_overlaps, overlaps;
  ASSERT_TRUE(bool(find_overlaps(a.view(), meshes.view(), expected_overlaps)));
  ASSERT_TRUE(bool(find_overlaps(a.view(), fields.view(), overlaps)));
  EXPECT_FALSE(overlaps.empty());
  EXPECT_TRUE(overlaps == expected_overlaps);
  for (const float within : {0.5f, std::numeric_limits<float>::infinity()}) {
    std::vector<NearestHit> expected, nearest;
    ASSERT_TRUE(bool(find_nearest(a.view(), within, meshes.view(), expected)));
    ASSERT_TRUE(bool(find_nearest(a.view(), within, fields.view(), nearest)));
    ASSERT_EQ(nearest.size(), expected.size());
    for (size_t i = 0; i < nearest.size(); ++i) {
      SCOPED_TRACE(i);
      EXPECT_EQ(nearest[i].query, expected[i].query);
      EXPECT_EQ(nearest[i].body, expected[i].body);
      EXPECT_EQ(nearest[i].sub_shape, expected[i].sub_shape);
      EXPECT_EQ(nearest[i].separation, expected[i].separation);
      EXPECT_EQ(nearest[i].normal, expected[i].normal);
      EXPECT_EQ(nearest[i].point_query, expected[i].point_query);
      EXPECT_EQ(nearest[i].point_body, expected[i].point_body);
    }
  }
}

}  // namespace
}  // namespace carom::test
