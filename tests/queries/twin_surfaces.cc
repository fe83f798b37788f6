#include "tests/queries/twin_surfaces.h"

#include <limits>

#include "carom/queries/queries.h"
#include "oracle/random.h"

namespace carom::test {

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

void expect_same_casts(const std::vector<PlacedShape>& queries, bool turn, double length,
                       const TwinSurfaces& twins) {
  const Sweeps sweeps = make_sweeps(queries.size(), length, turn, 4);
  for (const PositionType positions : kPositionTypes) {
    const LaidOut a(queries, {.positions = positions});
    const LaidOut surfaces(twins.surfaces, {.positions = positions});
    const LaidOut meshes(twins.meshes, {.positions = positions});
    for_each_isa([&] {
      for (const CastHits which : {CastHits::all, CastHits::closest}) {
        std::vector<CastHit> expected, hits;
        ASSERT_TRUE(bool(cast(a.view(), sweeps.view(), meshes.view(), expected, {.hits = which})));
        ASSERT_TRUE(bool(cast(a.view(), sweeps.view(), surfaces.view(), hits, {.hits = which})));
        EXPECT_FALSE(expected.empty());
        EXPECT_TRUE(bits_of(hits) == bits_of(expected)) << show(hits, expected);
      }
    });
  }
}

void expect_same_casts_of(const TwinSurfaces& twins, const std::vector<PlacedShape>& others) {
  const Sweeps sweeps = make_sweeps(twins.surfaces.size(), 5, true, 8);
  const LaidOut surfaces(twins.surfaces, {}), meshes(twins.meshes, {}), b(others, {});
  std::vector<CastHit> expected, hits;
  ASSERT_TRUE(bool(cast(meshes.view(), sweeps.view(), b.view(), expected)));
  ASSERT_TRUE(bool(cast(surfaces.view(), sweeps.view(), b.view(), hits)));
  EXPECT_TRUE(bits_of(hits) == bits_of(expected)) << show(hits, expected);
}

void expect_same_meetings(const std::vector<PlacedShape>& queries, const TwinSurfaces& twins) {
  const LaidOut a(queries, {}), surfaces(twins.surfaces, {}), meshes(twins.meshes, {});
  std::vector<OverlapHit> expected_overlaps, overlaps;
  ASSERT_TRUE(bool(find_overlaps(a.view(), meshes.view(), expected_overlaps)));
  ASSERT_TRUE(bool(find_overlaps(a.view(), surfaces.view(), overlaps)));
  EXPECT_FALSE(overlaps.empty());
  EXPECT_TRUE(overlaps == expected_overlaps);
  for (const float within : {0.5f, std::numeric_limits<float>::infinity()}) {
    std::vector<NearestHit> expected, nearest;
    ASSERT_TRUE(bool(find_nearest(a.view(), within, meshes.view(), expected)));
    ASSERT_TRUE(bool(find_nearest(a.view(), within, surfaces.view(), nearest)));
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

}  // namespace carom::test
