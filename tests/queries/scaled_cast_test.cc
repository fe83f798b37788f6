// Casts, overlaps and nearest bodies at surfaces with a scale equal those at meshes of the scaled
// triangles.
#include <gtest/gtest.h>

#include "carom/shapes/scaled.h"
#include "tests/queries/twin_surfaces.h"
#include "tests/support/height_fields.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

TwinSurfaces make_scaled_bodies(size_t count, uint64_t seed) {
  Composites shapes(seed);
  TwinSurfaces result;
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
      result.surfaces.push_back(body);
      body.shape = mesh_like(*made);
    } else {
      const Mesh like = mesh_like(*field);
      const auto made =
          *scaled(*make_mesh(like.geometry->vertices(), like.geometry->triangles(), rules), scale);
      body.shape = Mesh{made};
      result.surfaces.push_back(body);
      body.shape = Mesh{*unshared(*made)};
    }
    result.meshes.push_back(body);
  }
  return result;
}

TEST(ScaledCasts, OfRays) {
  const TwinSurfaces twins = make_scaled_bodies(8, 2);
  const auto rays = make_rays(rounds(300), 3);
  expect_same_casts(rays, false, 15, twins);
  expect_same_casts(rays, false, 1000, twins);
}

TEST(ScaledCasts, OfBodies) {
  const TwinSurfaces twins = make_scaled_bodies(8, 2);
  const auto queries = make_bodies({.count = rounds(60), .side = 10}, 5);
  expect_same_casts(queries, false, 8, twins);
  expect_same_casts(queries, true, 8, twins);
}

TEST(ScaledCasts, OfScaledBodies) {
  expect_same_casts_of(make_scaled_bodies(8, 7), make_bodies({.count = rounds(60), .side = 10}, 6));
}

TEST(ScaledQueries, EqualThoseOfOwnMeshes) {
  expect_same_meetings(make_bodies({.count = rounds(100), .side = 10}, 9),
                       make_scaled_bodies(8, 10));
}

}  // namespace
}  // namespace carom::test
