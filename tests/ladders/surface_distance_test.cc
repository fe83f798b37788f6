// Distances of surfaces: upper bounds, and tight, against samples in long double.
#include "ladders/surface_distance.h"

#include <gtest/gtest.h>

#include "tests/support/fine_meshes.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using ladders::furthest;

// The bound may be 2 % of `most` too large, and samples miss the furthest point.
void check(const MeshGeometry& from, const MeshGeometry& to, double most, int steps) {
  const double bound = furthest(from, to, most);
  const auto sampled = static_cast<double>(sampled_distance(from, to, steps));
  if (std::isinf(bound)) {
    EXPECT_GT(sampled * 1.1, most);
    return;
  }
  EXPECT_LE(bound, most);
  EXPECT_GE(bound, sampled);
  EXPECT_LE(bound, 1.1 * sampled + 0.03 * most);
}

TEST(SurfaceDistance, OfRandomMeshes) {
  int far = 0, near = 0;
  for (uint64_t seed = 0; seed < rounds(30, 10); ++seed) {
    Composites random(seed);
    const Mesh a = random.mesh(1), b = random.mesh(1);
    for (const double most : {0.1, 0.5, 4.0}) {
      (std::isinf(furthest(*a.geometry, *b.geometry, most)) ? far : near) += 1;
      check(*a.geometry, *b.geometry, most, 12);
    }
    check(*a.geometry, *a.geometry, 0.1, 1);
    if (HasFailure()) return;
  }
  EXPECT_GT(far, 5);
  EXPECT_GT(near, 5);
}

TEST(SurfaceDistance, OfFineAndCoarseBalls) {
  const auto bumpy = [](double x, double y, double z) {
    return 1 + 0.1 * std::sin(3 * x) * std::cos(2 * y + z);
  };
  const Mesh fine = ball_mesh(16, bumpy), coarse = ball_mesh(5, bumpy);
  for (const double most : {0.05, 0.2, 1.0}) {
    check(*fine.geometry, *coarse.geometry, most, 4);
    check(*coarse.geometry, *fine.geometry, most, 12);
  }
}

TEST(SurfaceDistance, OfFlatSurfacesIsNothing) {
  const Mesh fine = flat_grid(8, 0.5f), coarse = flat_grid(1, 4);
  EXPECT_LE(furthest(*fine.geometry, *coarse.geometry, 0.1), 1e-3);
  EXPECT_LE(furthest(*coarse.geometry, *fine.geometry, 0.1), 2e-3 + 0.002);
  // Whatever the size is.
  for (const float size : {1e-20f, 1e15f}) {
    const Mesh a = flat_grid(4, size), b = flat_grid(2, 2 * size);
    EXPECT_LE(furthest(*a.geometry, *b.geometry, size), 0.03 * size);
    EXPECT_LE(furthest(*b.geometry, *a.geometry, size), 0.03 * size);
  }
}

TEST(SurfaceDistance, TrianglesWithoutAreaDoNotCount) {
  const std::vector<Eigen::Vector3f> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 9}};
  const Mesh one = mesh_of(points, {{0, 1, 2}});
  const Mesh two = mesh_of(points, {{0, 1, 2}, {3, 3, 3}});
  EXPECT_LE(furthest(*two.geometry, *one.geometry, 0.1), 0.002);
  const Mesh none = mesh_of(points, {{3, 3, 3}});
  EXPECT_EQ(furthest(*none.geometry, *one.geometry, 0.1), 0);
  EXPECT_EQ(furthest(*one.geometry, *none.geometry, 0.1), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace carom::test
