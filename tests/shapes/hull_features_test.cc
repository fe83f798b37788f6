// Faces and edges of hulls, and hulls without usable features.
#include "shapes/hull_features.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>

#include "tests/support/hulls.h"

namespace carom::test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using Faces = std::vector<std::vector<uint32_t>>;

// Bit k of a corner is set if it is at the upper end of axis k.
const Faces kFacesOfCube = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                            {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

const HullFeatures* features_of(const Points& points, const Faces& faces,
                                std::shared_ptr<const HullGeometry>& hull) {
  hull = *make_hull(points, faces);
  return hull->features();
}

TEST(HullFeatures, OfACube) {
  std::shared_ptr<const HullGeometry> hull;
  const HullFeatures* const features = features_of(cube_corners(2), kFacesOfCube, hull);
  ASSERT_TRUE(features);
  ASSERT_EQ(features->face_count(), 6u);
  ASSERT_EQ(features->edges().size(), 12u);
  EXPECT_NEAR(features->inner_radius(), 2, 1e-4);
  EXPECT_LE(features->inner_radius(), 2);
  for (size_t f = 0; f < 6; ++f) {
    Vector3f normal = Vector3f::Zero();
    normal[static_cast<int>(f / 2)] = f % 2 ? 1.0f : -1.0f;
    EXPECT_EQ(features->normal(f), normal);
    EXPECT_EQ(features->height(f), 2);
    for (size_t i = 0; i < 4; ++i)
      EXPECT_EQ(features->column(i)[f], i < 3 ? normal[static_cast<int>(i)] : 2);
    ptrdiff_t edges = 0;
    for (const size_t side : {0, 1}) {
      edges += std::count(features->sides(side), features->sides(side) + 12, uint8_t(f));
    }
    EXPECT_EQ(edges, 4);
  }
}

// An edge runs across the normals of its two faces and lies in both of their planes.
TEST(HullFeatures, EdgesLieBetweenTheirFaces) {
  oracle::Random random(1);
  for (int round = 0; round < 50; ++round) {
    const Hull hull = oracle::hull_of(round_points(4 + random.below(40), {1, 2, 0.5f}, random));
    const HullFeatures* const features = hull.geometry->features();
    ASSERT_TRUE(features);
    ASSERT_EQ(hull.geometry->points().size() + features->face_count(),
              features->edges().size() + 2);
    for (uint32_t e = 0; e < features->edges().size(); ++e) {
      const HullFeatures::Edge& edge = features->edges()[e];
      const Vector3f& point = hull.geometry->points()[edge.from];
      for (const uint32_t f : {edge.left, edge.right}) {
        EXPECT_NEAR(features->normal(f).dot(point), features->height(f), 1e-5);
        EXPECT_NEAR(features->normal(f).dot(edge.direction.head<3>()), 0, 1e-5);
      }
      const Vector3f across = features->normal(edge.left).cross(features->normal(edge.right));
      EXPECT_EQ(features->sides(0)[e], edge.left);
      EXPECT_EQ(features->sides(1)[e], edge.right);
      EXPECT_NEAR(across.dot(edge.direction.head<3>()), across.norm(), 1e-5 + 1e-3 * across.norm());
    }
  }
}

// A cube, one corner of which is cut off just behind its tip.
TEST(HullFeatures, LeaveOutEdgesWithoutADirection) {
  for (const float cut : {0x1p-10f, 0x1p-18f, 0x1p-20f, 0x1p-22f}) {
    SCOPED_TRACE(cut);
    Points points = cube_corners();
    points[7].x() -= cut;
    points.push_back({1, 1 - cut, 1});
    points.push_back({1, 1, 1 - cut});
    const Faces faces = {{0, 4, 6, 2}, {1, 3, 9, 8, 5}, {0, 1, 5, 4}, {2, 6, 7, 9, 3},
                         {0, 2, 3, 1}, {4, 5, 8, 7, 6}, {7, 8, 9}};
    std::shared_ptr<const HullGeometry> hull;
    const HullFeatures* const features = features_of(points, faces, hull);
    ASSERT_TRUE(features);
    EXPECT_EQ(features->face_count(), 7u);
    // The three of the cut are its root of two long.
    EXPECT_EQ(features->edges().size(), cut > 0x1p-21f ? 15u : 12u);
  }
}

TEST(HullFeatures, NeedASolidWithAllPointsBehindItsFaces) {
  std::shared_ptr<const HullGeometry> hull;
  const Points cube = cube_corners();
  EXPECT_TRUE(features_of(cube, kFacesOfCube, hull));

  Faces open = kFacesOfCube;
  open.pop_back();
  EXPECT_FALSE(features_of(cube, open, hull)) << "a face is missing";

  Faces turned = kFacesOfCube;
  std::swap(turned[0][1], turned[0][3]);
  EXPECT_FALSE(features_of(cube, turned, hull)) << "a face looks inwards";

  Faces twice = kFacesOfCube;
  twice.push_back(twice[0]);
  EXPECT_FALSE(features_of(cube, twice, hull)) << "a face is given twice";

  Points outside = cube;
  outside.push_back({0, 0, 1.01f});
  EXPECT_FALSE(features_of(outside, kFacesOfCube, hull)) << "a point is outside";

  Points inside = cube;
  inside.push_back({0, 0.5f, 0});
  EXPECT_TRUE(features_of(inside, kFacesOfCube, hull)) << "a point is inside, which does no harm";

  EXPECT_FALSE(features_of(cube, {}, hull));
  const Points square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_FALSE(features_of(square, {{0, 1, 2, 3}, {3, 2, 1, 0}}, hull)) << "it is flat";
  Points collapsed = cube;
  for (const uint32_t i : kFacesOfCube[0]) collapsed[i] = {-1, 0, 0};
  EXPECT_FALSE(features_of(collapsed, kFacesOfCube, hull)) << "a face has no area";
}

}  // namespace
}  // namespace carom::test
