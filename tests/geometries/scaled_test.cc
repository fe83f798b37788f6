// Geometries and shapes with a scale: what they are, what they share, and which scales are refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "carom/shapes/scaled.h"
#include "shapes/hull_features.h"
#include "tests/support/height_fields.h"
#include "tests/support/hulls.h"
#include "tests/support/special_floats.h"

namespace carom::test {
namespace {

using Eigen::Vector3f;
using testing::HasSubstr;

using MeshPtr = std::shared_ptr<const MeshGeometry>;
using FieldPtr = std::shared_ptr<const HeightFieldGeometry>;

const Vector3f kSomeScales[] = {{2, 2, 2},           {-1, 1, 1},          {0.3f, 0.7f, 1.9f},
                                {1, -0.25f, -1.5f},  {-3, -0.4f, -1},     {1e-6f, 1e-6f, 1e-6f},
                                {1e6f, 1e6f, -1e6f}, {1e-3f, 1e3f, -2e2f}};

template <class T>
std::string scale_error(const Result<T>& result) {
  return result ? "" : result.error().message;
}

MeshPtr rough_mesh(const MeshRules& rules = {}) {
  oracle::Random random(1);
  return grid_mesh(
             6, 0.5f, [&](float, float) { return random.uniform(-0.3, 0.3); }, rules)
      .geometry;
}

// Corners, inner edges, bounds and triangles without area are those of `expected`.
template <class Geometry>
void expect_same_triangles(const Geometry& found, const MeshGeometry& expected, size_t count) {
  for (size_t t = 0; t < count; ++t) {
    if (expected.is_degenerate(t)) continue;
    EXPECT_EQ(found.corners(t), expected.corners(t));
    for (const bool from_front : {false, true}) {
      EXPECT_EQ(found.inner_edges(t, from_front), expected.inner_edges(t, from_front));
      for (unsigned i = 0; i < 3; ++i) {
        EXPECT_EQ(found.is_inner_edge(t, i, from_front),
                  (expected.inner_edges(t, from_front) >> i & 1) != 0);
      }
    }
  }
  EXPECT_EQ(found.lower(), expected.lower());
  EXPECT_EQ(found.upper(), expected.upper());
}

TEST(ScaledMesh, EqualsAMeshOfScaledPoints) {
  for (const MeshRules rules : {MeshRules{}, MeshRules{.one_sided = true, .thickness = 0.3f}}) {
    const MeshPtr mesh = rough_mesh(rules);
    for (const Vector3f& scale : kSomeScales) {
      const MeshPtr found = *scaled(mesh, scale);
      std::vector<Vector3f> points;
      for (const Vector3f& v : mesh->vertices()) points.push_back(v.cwiseProduct(scale));
      Triangles triangles(mesh->triangles().begin(), mesh->triangles().end());
      if (scale.prod() < 0) {
        for (auto& [a, b, c] : triangles) std::swap(b, c);
      }
      const MeshPtr expected = *make_mesh(points, triangles, rules);
      EXPECT_TRUE(found->is_scaled());
      EXPECT_EQ(found->scale(), scale);
      EXPECT_EQ(found->rules().thickness, rules.thickness);
      expect_same_triangles(*found, *expected, triangles.size());
      for (size_t t = 0; t < triangles.size(); ++t) {
        EXPECT_EQ(found->corner_numbers(t), triangles[t]);
      }
    }
  }
}

TEST(ScaledMesh, SharesTheRest) {
  MeshPtr mesh = rough_mesh();
  const MeshPtr twice = *scaled(mesh, {2, -2, 2});
  EXPECT_EQ(twice->vertices().data(), mesh->vertices().data());
  EXPECT_EQ(twice->triangles().data(), mesh->triangles().data());
  EXPECT_EQ(&twice->tree(), &mesh->tree());
  EXPECT_EQ(*scaled(mesh, {1, 1, 1}), mesh);
  const MeshPtr back = *scaled(twice, {0.5f, -0.5f, 0.5f});
  EXPECT_FALSE(back->is_scaled());
  EXPECT_EQ(back->lower(), mesh->lower());
  EXPECT_EQ(back->upper(), mesh->upper());
  expect_same_triangles(*back, *mesh, mesh->triangles().size());
  const auto corners = twice->corners(7);
  mesh.reset();
  EXPECT_EQ(twice->corners(7), corners);
  EXPECT_FALSE(twice->tree().is_empty());
}

TEST(ScaledMesh, ThousandTakeLittleMemory) {
  oracle::Random random(2);
  const MeshPtr mesh =
      grid_mesh(224, 0.1f, [&](float, float) { return random.uniform(0, 1); }).geometry;
  ASSERT_GT(mesh->triangles().size(), 100'000u);
  const size_t before = mesh->bytes();
  size_t sum = 0;
  std::vector<MeshPtr> all;
  for (int i = 0; i < 1000; ++i) {
    const auto factor = 1 + 0.001f * static_cast<float>(i + 1);
    all.push_back(*scaled(mesh, {factor, 1, i % 2 ? -1.0f : 1.0f}));
    sum += all.back()->bytes();
  }
  EXPECT_LT(sum, before / 10);
  EXPECT_LT(mesh->bytes(), before + before / 2);
}

TEST(ScaledMesh, WithoutAreaIsOneOfItsOwn) {
  const MeshPtr mesh = flat_grid(3, 1).geometry;
  const MeshPtr flat = *scaled(mesh, {1e-30f, 1, 1});
  EXPECT_NE(flat->vertices().data(), mesh->vertices().data());
  EXPECT_FALSE(flat->is_scaled());
  EXPECT_EQ(flat->degenerate_count(), flat->triangles().size() / 2);
}

TEST(ScaledMesh, BadScalesAreRefused) {
  const MeshPtr mesh = rough_mesh();
  for (const float bad : {0.0f, kNan, kInfinity, -kInfinity}) {
    EXPECT_THAT(scale_error(scaled(mesh, {1, bad, 1})), HasSubstr("0 or not finite"));
    EXPECT_THAT(scale_error(scaled(Shape(Sphere{1}), {bad, 1, 1})), HasSubstr("0 or not finite"));
  }
  EXPECT_THAT(scale_error(scaled(mesh, {3e38f, 1, 1})), HasSubstr("leaves the range of float32"));
  const MeshPtr great = *scaled(mesh, {1e20f, 1e20f, 1e20f});
  EXPECT_THAT(scale_error(scaled(great, {1e20f, 1e20f, 1e20f})), HasSubstr("leaves the range"));
  EXPECT_THAT(scale_error(scaled(MeshPtr(), {1, 2, 3})), HasSubstr("without geometry"));
  EXPECT_THAT(scale_error(scaled(Shape(Sphere{1e30f}), {1e10f, 1, 1})),
              HasSubstr("a sphere by the scale (1e+10, 1, 1) leaves the range of float32"));
}

TEST(ScaledField, EqualsAMeshOfScaledPoints) {
  oracle::Random random(3);
  for (const Vector3f& scale : kSomeScales) {
    const FieldPtr field = geometry_of(random_heights(9, 7, 0.4, 0.1, random));
    const FieldPtr found = *scaled(field, scale);
    const Mesh expected = mesh_like(*found);
    expect_same_triangles(*found, *expected.geometry, found->triangle_count());
    EXPECT_EQ(found->row(0), field->row(0));
    EXPECT_LT(found->bytes(), field->bytes());
    EXPECT_EQ(*scaled(*scaled(field, {-1, 2, 1}), {-1, 0.5f, 1}), field);
  }
}

TEST(ScaledField, BadOnesAreRefused) {
  oracle::Random random(4);
  const FieldPtr field = geometry_of(random_heights(5, 5, 1, 0, random));
  EXPECT_THAT(scale_error(scaled(field, {1, 1, 1e20f})), HasSubstr("heights out of range"));
  EXPECT_THAT(scale_error(scaled(field, {1e-20f, 1, 1})), HasSubstr("without cells"));
  EXPECT_THAT(scale_error(scaled(field, {1, 0, 1})), HasSubstr("0 or not finite"));
  const auto made = std::const_pointer_cast<HeightFieldGeometry>(*scaled(field, {2, 2, 2}));
  const float sample = 0;
  EXPECT_FALSE(made->update({0, 0, 1, 1}, {.data = &sample}));
}

TEST(ScaledHull, HasTheSameFaces) {
  const auto box = std::get<Hull>(placed_hull(box_corners({0.5f, 1, 1.5f})).shape);
  for (const Vector3f& scale : kSomeScales) {
    const auto found = *scaled(box.geometry, scale);
    ASSERT_EQ(found->points().size(), box.geometry->points().size());
    for (size_t i = 0; i < found->points().size(); ++i) {
      EXPECT_EQ(found->points()[i], box.geometry->points()[i].cwiseProduct(scale));
    }
    ASSERT_TRUE(found->features());  // so that outlines are counter-clockwise
    for (size_t f = 0; f < found->faces().size(); ++f) {
      const Vector3f normal = box.geometry->features()->normal(f).cwiseProduct(scale.cwiseSign());
      EXPECT_LT((found->features()->normal(f) - normal).norm(), 1e-6f);
    }
  }
}

Shape made(const Shape& shape, const Vector3f& scale) {
  const Result<Shape> result = scaled(shape, scale);
  EXPECT_TRUE(result) << result.error().message;
  return result ? *result : Shape(Sphere{});
}

TEST(ScaledSimpleShapes, StayOfTheirKindWhereTheyCan) {
  EXPECT_EQ(std::get<Sphere>(made(Sphere{2}, {-3, 3, 3})).radius, 6);
  EXPECT_EQ(std::get<Ellipsoid>(made(Sphere{2}, {1, -2, 3})).semi_axes, Vector3f(2, 4, 6));
  EXPECT_EQ(std::get<Box>(made(Box{{1, 2, 3}}, {-1, 2, 3})).half, Vector3f(1, 4, 9));
  const Aabb box = std::get<Aabb>(made(Aabb{{-1, -2, -3}, {2, 3, 4}}, {-2, 1, 1}));
  EXPECT_EQ(box.lower, Vector3f(-4, -2, -3));
  EXPECT_EQ(box.upper, Vector3f(2, 3, 4));
  const Capsule capsule = std::get<Capsule>(made(Capsule{{1, 2, 3}, {0, 0, 1}, 1}, {2, -2, 2}));
  EXPECT_EQ(capsule.a, Vector3f(2, -4, 6));
  EXPECT_EQ(capsule.radius, 2);
  EXPECT_EQ(std::get<Capsule>(made(Capsule{{1, 2, 3}, {0, 0, 1}, 0}, {1, 2, 3})).a,
            Vector3f(1, 4, 9));
  const Cylinder cylinder = std::get<Cylinder>(made(Cylinder{1, 2}, {-2, 2, -3}));
  EXPECT_EQ(cylinder.radius, 2);
  EXPECT_EQ(cylinder.half_length, 6);
  EXPECT_EQ(std::get<Cone>(made(Cone{1, 2}, {-2, 2, 3})).half_length, 6);
  EXPECT_EQ(std::get<Ellipsoid>(made(Ellipsoid{{1, 2, 3}}, {1, -2, 3})).semi_axes,
            Vector3f(1, 4, 9));
  const Halfspace plane = std::get<Halfspace>(made(Halfspace{{0, 0, 1}, 2}, {1, 1, -3}));
  EXPECT_EQ(plane.offset / plane.normal.norm(), 6);
  EXPECT_LT(plane.normal.z(), 0);
  EXPECT_TRUE(std::holds_alternative<Dop>(
      made(Dop::of_points(std::vector<Vector3f>{{0, 0, 0}, {1, 2, 3}}, DopKind::k26), {2, -2, 2})));
  EXPECT_TRUE(std::holds_alternative<Hull>(
      made(Dop::of_points(std::vector<Vector3f>{{0, 0, 0}, {1, 2, 3}}, DopKind::k26), {2, -2, 1})));
  EXPECT_TRUE(std::holds_alternative<Dop>(
      made(Dop::of_points(std::vector<Vector3f>{{0, 0, 0}, {1, 2, 3}}, DopKind::k6), {2, -2, 1})));
}

TEST(ScaledSimpleShapes, BecomeCompoundsWhereTheyLieElsewhere) {
  const Compound cone = std::get<Compound>(made(Cone{1, 2}, {1, 1, -1}));
  ASSERT_EQ(cone.geometry->children().size(), 1u);
  EXPECT_NEAR(cone.geometry->lower().z(), -2, 1e-6);
  const Compound ball = std::get<Compound>(made(Capsule{{1, 2, 3}, {1, 2, 3}, 1}, {1, 2, 3}));
  EXPECT_EQ(ball.geometry->children()[0].position, Vector3f(1, 4, 9));
}

TEST(ScaledSimpleShapes, ThatWouldBeNoShapesAreRefused) {
  EXPECT_THAT(scale_error(scaled(Shape(Capsule{{1, 0, 0}, {0, 0, 0}, 1}), {1, 2, 1})),
              HasSubstr("a capsule by the scale (1, 2, 1) is no shape"));
  EXPECT_THAT(scale_error(scaled(Shape(Cylinder{1, 1}), {1, 2, 1})),
              HasSubstr("a cylinder by the scale (1, 2, 1) is no shape"));
  EXPECT_THAT(scale_error(scaled(Shape(Cone{1, 1}), {1, 2, 1})),
              HasSubstr("a cone by the scale (1, 2, 1) is no shape"));
  const std::vector<CompoundChild> turned = {
      {Sphere{1}}, {Cylinder{1, 2}, Vector3f::Zero(), Orientation(1, 0.3f, 0, 0)}};
  EXPECT_THAT(scale_error(scaled(*make_compound(turned), {1, 1, 2})),
              HasSubstr("child 1 of the compound: a cylinder would be sheared"));
  EXPECT_TRUE(scaled(*make_compound(turned), {2, -2, 2}));
}

TEST(ScaledCompounds, ChildrenShareWhatTheyShared) {
  const MeshPtr mesh = rough_mesh();
  std::vector<CompoundChild> children(3, CompoundChild{Mesh{mesh}});
  children[1].position = {5, 0, 0};
  children[2].orientation = Orientation(0, 0, 0, 1);
  const auto found = *scaled(*make_compound(children), {2, 3, 4});
  const auto mesh_of_child = [&](size_t i) {
    return std::get<Mesh>(found->children()[i].shape).geometry;
  };
  EXPECT_EQ(mesh_of_child(0), mesh_of_child(1));
  EXPECT_EQ(mesh_of_child(0)->vertices().data(), mesh->vertices().data());
  EXPECT_EQ(mesh_of_child(2)->vertices().data(), mesh->vertices().data());
  EXPECT_EQ(found->children()[1].position, Vector3f(10, 0, 0));
}

}  // namespace
}  // namespace carom::test
