// Casts, overlaps and nearest bodies at surfaces with a scale equal those at meshes of the scaled
// triangles.
#include <gtest/gtest.h>

#include "carom/queries/queries.h"
#include "carom/shapes/scaled.h"
#include "tests/support/cast_checks.h"
#include "tests/support/height_fields.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

struct ScaledBodies {
  std::vector<PlacedShape> scaled_ones, own;
};

ScaledBodies make_scaled_bodies(size_t count, uint64_t seed) {
  Composites shapes(seed);
  ScaledBodies result;
  for (size_t i = 0; i < count; ++i) {
    const auto nx = static_cast<uint32_t>(2 + shapes.random().below(20));
    const auto ny = static_cast<uint32_t>(2 + shapes.random().below(20));
    const auto field = geometry_of(random_heights(nx, ny, 0.7, i % 2 ? 0.05 : 0, shapes.random()));
    PlacedShape body = {Sphere{}, Eigen::Vector3d(5, 5, 5), Eigen::Quaternionf::Identity()};
    if (i % 3 != 0) body.orientation = shapes.orientation();
    const Eigen::Vector3f scale = shapes.scale();
    const MeshRules rules = {.one_sided = i % 4 == 1, .thickness = i % 4 == 3 ? 0.2f : 0};
    if (i % 2 == 0) {
      const auto made = *scaled(std::shared_ptr<const HeightFieldGeometry>(field), scale);
      body.shape = HeightField{made};
      result.scaled_ones.push_back(body);
      body.shape = mesh_like(*made);
    } else {
      const Mesh like = mesh_like(*field);
      const auto made =
          *scaled(*make_mesh(like.geometry->vertices(), like.geometry->triangles(), rules), scale);
      body.shape = Mesh{made};
      result.scaled_ones.push_back(body);
      body.shape = Mesh{*unshared(*made)};
    }
    result.own.push_back(body);
  }
  return result;
}

void expect_same_casts_at_scaled(const std::vector<PlacedShape>& queries, bool turn,
                                 double length) {
  const ScaledBodies bodies = make_scaled_bodies(8, 2);
  const Sweeps sweeps = make_sweeps(queries.size(), length, turn, 4);
  for (const PositionType positions : kPositionTypes) {
    const LaidOut a(queries, {.positions = positions});
    const LaidOut scaled_ones(bodies.scaled_ones, {.positions = positions});
    const LaidOut own(bodies.own, {.positions = positions});
    for_each_isa([&] {
      for (const CastHits which : {CastHits::all, CastHits::closest}) {
        std::vector<CastHit> expected, hits;
        ASSERT_TRUE(bool(cast(a.view(), sweeps.view(), own.view(), expected, {.hits = which})));
        ASSERT_TRUE(bool(cast(a.view(), sweeps.view(), scaled_ones.view(), hits, {.hits = which})));
        EXPECT_FALSE(expected.empty());
        EXPECT_TRUE(bits_of(hits) == bits_of(expected)) << show(hits, expected);
      }
    });
  }
}

TEST(ScaledCasts, OfRays) {
  oracle::Random random(3);
  std::vector<PlacedShape> rays;
  for (size_t i = 0; i < rounds(300); ++i) {
    rays.push_back({Sphere{0},
                    {random.uniform(-5, 15), random.uniform(-5, 15), random.uniform(-5, 15)},
                    Eigen::Quaternionf::Identity()});
  }
  expect_same_casts_at_scaled(rays, false, 15);
  expect_same_casts_at_scaled(rays, false, 1000);
}

TEST(ScaledCasts, OfBodies) {
  const auto queries = make_bodies({.count = rounds(60), .side = 10}, 5);
  expect_same_casts_at_scaled(queries, false, 8);
  expect_same_casts_at_scaled(queries, true, 8);
}

TEST(ScaledCasts, OfScaledBodies) {
  const auto others = make_bodies({.count = rounds(60), .side = 10}, 6);
  const ScaledBodies bodies = make_scaled_bodies(8, 7);
  const Sweeps sweeps = make_sweeps(bodies.own.size(), 5, true, 8);
  const LaidOut scaled_ones(bodies.scaled_ones, {}), own(bodies.own, {}), b(others, {});
  std::vector<CastHit> expected, hits;
  ASSERT_TRUE(bool(cast(own.view(), sweeps.view(), b.view(), expected)));
  ASSERT_TRUE(bool(cast(scaled_ones.view(), sweeps.view(), b.view(), hits)));
  EXPECT_TRUE(bits_of(hits) == bits_of(expected)) << show(hits, expected);
}

TEST(ScaledQueries, EqualThoseOfOwnMeshes) {
  const auto queries = make_bodies({.count = rounds(100), .side = 10}, 9);
  const ScaledBodies bodies = make_scaled_bodies(8, 10);
  const LaidOut a(queries, {}), scaled_ones(bodies.scaled_ones, {}), own(bodies.own, {});
  std::vector<OverlapHit> expected_overlaps, overlaps;
  ASSERT_TRUE(bool(find_overlaps(a.view(), own.view(), expected_overlaps)));
  ASSERT_TRUE(bool(find_overlaps(a.view(), scaled_ones.view(), overlaps)));
  EXPECT_FALSE(overlaps.empty());
  EXPECT_TRUE(overlaps == expected_overlaps);
  for (const float within : {0.5f, std::numeric_limits<float>::infinity()}) {
    std::vector<NearestHit> expected, nearest;
    ASSERT_TRUE(bool(find_nearest(a.view(), within, own.view(), expected)));
    ASSERT_TRUE(bool(find_nearest(a.view(), within, scaled_ones.view(), nearest)));
    ASSERT_EQ(nearest.size(), expected.size());
    for (size_t i = 0; i < nearest.size(); ++i) {
      SCOPED_TRACE(i);
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
