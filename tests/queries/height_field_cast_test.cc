// Casts, overlaps and nearest bodies at height fields equal those at meshes of the same triangles.
#include <gtest/gtest.h>

#include "tests/queries/twin_surfaces.h"
#include "tests/support/height_fields.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

TwinSurfaces make_fields(size_t count, uint64_t seed) {
  Composites shapes(seed);
  TwinSurfaces result;
  for (size_t i = 0; i < count; ++i) {
    const auto nx = static_cast<uint32_t>(2 + shapes.random().below(40));
    const auto ny = static_cast<uint32_t>(2 + shapes.random().below(40));
    const auto field = geometry_of(random_heights(nx, ny, 0.7, i % 2 ? 0.05 : 0, shapes.random()));
    PlacedShape body = {HeightField{field}, Eigen::Vector3d(5, 5, 5),
                        Eigen::Quaternionf::Identity()};
    if (i % 3 != 0) body.orientation = shapes.orientation();
    result.surfaces.push_back(body);
    body.shape = mesh_like(*field);
    result.meshes.push_back(body);
  }
  return result;
}

TEST(HeightFieldCasts, OfRays) {
  const TwinSurfaces twins = make_fields(6, 2);
  expect_same_casts(make_rays(rounds(300), 3), false, 15, twins);
  expect_same_casts(make_rays(rounds(100), 4), false, 1000, twins);
}

TEST(HeightFieldCasts, OfBodies) {
  const TwinSurfaces twins = make_fields(6, 2);
  const auto queries = make_bodies({.count = rounds(60), .side = 10}, 5);
  expect_same_casts(queries, false, 8, twins);
  expect_same_casts(queries, true, 8, twins);
}

TEST(HeightFieldCasts, OfHeightFields) {
  expect_same_casts_of(make_fields(6, 7), make_bodies({.count = rounds(60), .side = 10}, 6));
}

TEST(HeightFieldQueries, EqualThoseOfMeshes) {
  expect_same_meetings(make_bodies({.count = rounds(100), .side = 10}, 9), make_fields(8, 10));
}

}  // namespace
}  // namespace carom::test
