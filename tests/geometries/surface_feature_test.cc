// Names of features: points of one vertex, edge or face share a name, and no two features do.
#include "geometries/surface_feature.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "midphase/placed_part.h"
#include "oracle/random.h"
#include "tests/support/composites.h"
#include "tests/support/layouts.h"

namespace carom::test {
namespace {

using Eigen::Vector3f;

// The part of a shape, which must outlive it.
class PartOf {
 public:
  explicit PartOf(const Shape& shape)
      : laid_out_(std::vector<PlacedShape>{{shape}}, {}), view_(laid_out_.view()) {}

  uint32_t name(const Double3& point, uint32_t triangle = kNoTriangle) const {
    return surface_feature(body_part(BodyReader{view_}, 0), triangle, point);
  }

 private:
  LaidOut laid_out_;
  Collidables view_;
};

// The names of all 26 features of a box with these ends, and of random points on each of them.
void expect_box_features(const Shape& shape, const Vector3f& lower, const Vector3f& upper) {
  const PartOf part(shape);
  oracle::Random random(5);
  std::set<uint32_t> names;
  for (int code = 0; code < 27; ++code) {
    const int side[3] = {code % 3, code / 3 % 3, code / 9};
    if (side[0] == 2 && side[1] == 2 && side[2] == 2) continue;
    std::set<uint32_t> of_feature;
    for (int i = 0; i < 20; ++i) {
      Double3 point;
      for (size_t axis = 0; axis < 3; ++axis) {
        const double low = lower[axis], high = upper[axis];
        point[axis] = side[axis] == 0 ? low
                      : side[axis] == 1
                          ? high
                          : random.uniform(0.9 * low + 0.1 * high, 0.1 * low + 0.9 * high);
        point[axis] *= 1 + random.uniform(-1e-6, 1e-6);
      }
      of_feature.insert(part.name(point));
    }
    EXPECT_EQ(of_feature.size(), 1u) << code;
    EXPECT_TRUE(names.insert(*of_feature.begin()).second) << code;
  }
  EXPECT_EQ(names.size(), 26u);
  EXPECT_FALSE(names.contains(0));
}

TEST(SurfaceFeatures, OfBoxes) {
  expect_box_features(Box{{1, 2, 3}}, {-1, -2, -3}, {1, 2, 3});
  expect_box_features(Box{{1e-20f, 2e-20f, 1e-20f}}, {-1e-20f, -2e-20f, -1e-20f},
                      {1e-20f, 2e-20f, 1e-20f});
  expect_box_features(Aabb{{1, -2, 3}, {2, 5, 4}}, {1, -2, 3}, {2, 5, 4});
}

TEST(SurfaceFeatures, OfAHull) {
  const std::vector<Vector3f> corners = {
      {-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {0, 0, 1}};
  const Hull hull{
      *make_hull(corners, std::vector<std::vector<uint32_t>>{
                              {3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}})};
  const PartOf part(hull);
  std::set<uint32_t> names;
  const auto at = [](const Vector3f& v) { return Double3{v.x(), v.y(), v.z()}; };
  for (const Vector3f& corner : corners) names.insert(part.name(at(corner)));
  for (const HullGeometry::Face& face : hull.geometry->faces()) {
    const auto indices = hull.geometry->corners(face);
    Vector3f middle = Vector3f::Zero();
    for (size_t i = 0; i < indices.size(); ++i) {
      const Vector3f &a = corners[indices[i]], &b = corners[indices[(i + 1) % indices.size()]];
      middle += a / float(indices.size());
      names.insert(part.name(at(0.5f * (a + b))));
      EXPECT_EQ(part.name(at(0.5f * (a + b))), part.name(at(0.25f * a + 0.75f * b)));
    }
    names.insert(part.name(at(middle)));
  }
  EXPECT_EQ(names.size(), 5u + 8u + 5u);  // corners, edges, faces
}

TEST(SurfaceFeatures, OfMeshesAreSharedByTriangles) {
  const Mesh mesh = flat_grid(3, 1);
  const PartOf part(mesh);
  std::map<uint32_t, Double3> seen;  // the middle of each feature
  const auto& triangles = mesh.geometry->triangles();
  size_t shared = 0;
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    const auto corner_at = [&](size_t i) { return corner(*mesh.geometry, t, i); };
    const auto check = [&](const Double3& point) {
      const auto [entry, is_new] = seen.insert({part.name(point, t), point});
      EXPECT_EQ(entry->second, point);
      shared += !is_new;
    };
    for (size_t i = 0; i < 3; ++i) {
      check(corner_at(i));
      const Double3 a = corner_at(i), b = corner_at((i + 1) % 3);
      check({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2});
    }
    const Double3 a = corner_at(0), b = corner_at(1), c = corner_at(2);
    check({(a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3, (a[2] + b[2] + c[2]) / 3});
  }
  EXPECT_EQ(seen.size(), 16u + 33u + 18u);  // corners, edges, triangles
  EXPECT_GT(shared, 20u);
}

TEST(SurfaceFeatures, OfCapsulesAndSmoothShapes) {
  const PartOf capsule(Capsule{{0, 0, -1}, {0, 0, 1}, 0.5f});
  EXPECT_EQ(capsule.name({0.5, 0, 0}), capsule.name({0, 0.5, 0.75}));
  EXPECT_EQ(capsule.name({0, 0, 1.5}), capsule.name({0.5, 0, 1}));
  EXPECT_NE(capsule.name({0, 0, 1.5}), capsule.name({0, 0, -1.5}));
  EXPECT_NE(capsule.name({0, 0, 1.5}), capsule.name({0.5, 0, 0}));
  const PartOf ball(Sphere{1}), ground(Halfspace{});
  EXPECT_EQ(ball.name({1, 0, 0}), ball.name({0, 1, 0}));
  EXPECT_EQ(ground.name({1, 0, 0}), ground.name({-7, 1, 0}));
  EXPECT_NE(ball.name({1, 0, 0}), 0u);
}

TEST(SurfaceFeatures, OfDops) {
  Dop dop;
  dop.kind = DopKind::k14;
  for (size_t i = 0; i < slab_count(dop.kind); ++i) {
    dop.lower[i] = i < 3 ? -1.0f : -2.0f;
    dop.upper[i] = i < 3 ? 1.0f : 2.0f;
  }
  const PartOf part(dop);
  EXPECT_EQ(part.name({1, 0, 0}), part.name({1, 0.5, 0.25}));
  EXPECT_NE(part.name({1, 0, 0}), part.name({-1, 0, 0}));
  EXPECT_NE(part.name({1, 0, 0}), part.name({0.75, 0.625, 0.625}));  // x + y + z = 2
  EXPECT_NE(part.name({1, 1, 0}), part.name({1, 0.5, 0.25}));
}

TEST(SurfaceFeatures, OfChildrenDiffer) {
  std::set<uint32_t> names;
  for (uint32_t child = 0; child < 100; ++child) {
    for (uint32_t feature = 1; feature < 50; ++feature) {
      names.insert(feature_of_child(child, feature));
    }
  }
  EXPECT_EQ(names.size(), 100u * 49u);
  EXPECT_EQ(feature_of_child(0, 5), 5u);
}

}  // namespace
}  // namespace carom::test
