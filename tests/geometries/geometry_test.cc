// Geometries of meshes and compounds: which inputs are refused, which triangles are skipped, and
// what the accessors return.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "carom/shapes/compound_geometry.h"
#include "carom/shapes/mesh_geometry.h"
#include "tests/support/special_floats.h"

namespace carom::test {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;
using testing::HasSubstr;
using TriangleList = std::vector<std::array<uint32_t, 3>>;

const std::vector<Vector3f> kSquare = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const TriangleList kHalves = {{0, 1, 2}, {0, 2, 3}};

template <class T>
std::string error_of(const Result<T>& result) {
  return result ? "" : result.error().message;
}

TEST(MeshGeometry, BadDataIsRefused) {
  EXPECT_THAT(error_of(make_mesh(kSquare, {})), HasSubstr("without triangles"));
  EXPECT_THAT(error_of(make_mesh(kSquare, TriangleList{{0, 1, 4}})), HasSubstr("triangle 0"));
  for (const float bad : {kNan, kInfinity, -kInfinity}) {
    std::vector<Vector3f> vertices = kSquare;
    vertices[2].y() = bad;
    EXPECT_THAT(error_of(make_mesh(vertices, kHalves)), HasSubstr("vertex 2"));
  }
  for (const float bad : {kNan, kInfinity, -1.0f}) {
    EXPECT_THAT(error_of(make_mesh(kSquare, kHalves, {.thickness = bad})), HasSubstr("thickness"));
  }
  EXPECT_TRUE(make_mesh(kSquare, kHalves));
}

TEST(MeshGeometry, TrianglesAreAsGiven) {
  const auto mesh = *make_mesh(kSquare, kHalves, {.one_sided = true, .thickness = 0.5f});
  EXPECT_TRUE(std::equal(kSquare.begin(), kSquare.end(), mesh->vertices().begin()));
  EXPECT_TRUE(std::equal(kHalves.begin(), kHalves.end(), mesh->triangles().begin()));
  EXPECT_TRUE(mesh->rules().one_sided);
  EXPECT_EQ(mesh->rules().thickness, 0.5f);
}

TEST(MeshGeometry, BoundsHoldTheThickness) {
  EXPECT_EQ((*make_mesh(kSquare, kHalves))->lower(), Vector3f(0, 0, 0));
  EXPECT_EQ((*make_mesh(kSquare, kHalves))->upper(), Vector3f(1, 1, 0));
  const auto thick = *make_mesh(kSquare, kHalves, {.thickness = 0.5f});
  EXPECT_LE(thick->lower().z(), -0.5f);
  EXPECT_GE(thick->lower().z(), -0.50001f);
  EXPECT_LE(thick->upper().z(), 0.00001f);
}

TEST(MeshGeometry, TrianglesWithoutAreaAreCounted) {
  std::vector<Vector3f> vertices = kSquare;
  vertices.push_back({2, 0, 0});
  vertices.push_back({1, 0, 0});  // the same vertex again
  const auto mesh = *make_mesh(
      vertices, TriangleList{{0, 1, 2}, {0, 1, 4}, {3, 3, 3}, {1, 2, 1}, {1, 5, 2}, {0, 2, 3}});
  EXPECT_EQ(mesh->degenerate_count(), 4u);
  const std::vector<bool> expected = {false, true, true, true, true, false};
  for (size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(mesh->is_degenerate(i), expected[i]) << i;
}

TEST(MeshGeometry, FlatEdgesAreInnerFromBothSides) {
  const auto mesh = *make_mesh(kSquare, kHalves);
  for (const bool from_front : {true, false}) {
    EXPECT_EQ(mesh->inner_edges(0, from_front), 0b100);  // the edge from corner 2 to 0
    EXPECT_EQ(mesh->inner_edges(1, from_front), 0b001);  // the edge from corner 0 to 2
  }
}

TEST(MeshGeometry, VerticesAtOnePlaceAreOne) {
  std::vector<Vector3f> vertices = kSquare;
  vertices.push_back({-0.0f, 0, -0.0f});
  vertices.push_back({1, 1, 0});
  const auto mesh = *make_mesh(vertices, TriangleList{{0, 1, 2}, {4, 5, 3}});
  EXPECT_EQ(mesh->inner_edges(0, true), 0b100);
  EXPECT_EQ(mesh->inner_edges(1, true), 0b001);
}

TEST(MeshGeometry, BentEdgesAreInnerFromInside) {
  std::vector<Vector3f> vertices = kSquare;
  for (const float z : {0.5f, -0.5f}) {
    vertices[3].z() = z;
    const auto mesh = *make_mesh(vertices, kHalves);
    EXPECT_EQ(mesh->inner_edges(0, z > 0), 0b100);
    EXPECT_EQ(mesh->inner_edges(0, z < 0), 0);
    EXPECT_EQ(mesh->inner_edges(1, z > 0), 0b001);
    EXPECT_EQ(mesh->inner_edges(1, z < 0), 0);
  }
}

// The neighbour's winding does not matter, only its position.
TEST(MeshGeometry, NeighboursMayLookTheOtherWay) {
  const auto mesh = *make_mesh(kSquare, TriangleList{{0, 1, 2}, {0, 3, 2}});
  EXPECT_EQ(mesh->inner_edges(0, true), 0b100);
  EXPECT_EQ(mesh->inner_edges(1, false), 0b100);
}

TEST(MeshGeometry, EdgesOfThreeTrianglesOrFoldedOnesAreNotInner) {
  std::vector<Vector3f> vertices = kSquare;
  vertices.push_back({0, 0, 1});
  vertices.push_back({0.75f, 0.25f, 0});
  const auto three = *make_mesh(vertices, TriangleList{{0, 1, 2}, {0, 2, 3}, {0, 2, 4}});
  const auto folded = *make_mesh(vertices, TriangleList{{0, 1, 2}, {0, 2, 5}});
  const auto twice = *make_mesh(vertices, TriangleList{{0, 1, 2}, {0, 1, 2}});
  for (const bool from_front : {true, false}) {
    for (size_t i = 0; i < 3; ++i) EXPECT_EQ(three->inner_edges(i, from_front), 0);
    for (size_t i = 0; i < 2; ++i) EXPECT_EQ(folded->inner_edges(i, from_front), 0);
    for (size_t i = 0; i < 2; ++i) EXPECT_EQ(twice->inner_edges(i, from_front), 0);
  }
}

CompoundChild child(const Shape& shape) { return {.shape = shape}; }

std::string error_of(const CompoundChild& bad) {
  const std::vector<CompoundChild> children = {child(Sphere{1}), bad};
  return error_of(make_compound(children));
}

TEST(CompoundGeometry, BadDataIsRefused) {
  EXPECT_THAT(error_of(make_compound({})), HasSubstr("without children"));
  const std::vector<CompoundChild> one = {child(Sphere{1})};
  EXPECT_THAT(error_of(child(Compound{*make_compound(one)})), HasSubstr("compound itself"));
  EXPECT_THAT(error_of(child(Halfspace{})), HasSubstr("half-space"));
  for (const Shape& shape : {Shape(Hull{}), Shape(Mesh{})}) {
    EXPECT_THAT(error_of(child(shape)), HasSubstr("no geometry"));
  }
  for (const Shape& shape : {Shape(Sphere{-1}), Shape(Sphere{kNan}), Shape(Box{{1, -1, 1}}),
                             Shape(Aabb{{1, 0, 0}, {0, 0, 0}}),
                             Shape(Capsule{Vector3f(0, 0, 0), Vector3f(0, 0, kInfinity), 1})}) {
    EXPECT_THAT(error_of(child(shape)), HasSubstr("child 1 of the compound has a shape"));
  }
  CompoundChild bad = child(Sphere{1});
  bad.position.x() = kNan;
  EXPECT_THAT(error_of(bad), HasSubstr("position"));
  bad.position.x() = 0;
  bad.orientation = Quaternionf(0, 0, 0, 0);
  EXPECT_THAT(error_of(bad), HasSubstr("orientation"));
  bad.orientation = Quaternionf(1, kInfinity, 0, 0);
  EXPECT_THAT(error_of(bad), HasSubstr("orientation"));
  bad.orientation = Quaternionf(0, -0.25f, 0, 0);
  EXPECT_EQ(error_of(bad), "");
}

TEST(CompoundGeometry, BoundsHoldAllChildren) {
  const std::vector<CompoundChild> children = {
      {Sphere{0.5f}, {-3, 0, 0}, Quaternionf::Identity()},
      {Aabb{{0, 0, 1}, {1, 4, 2}}, {0, 0, 1}, Quaternionf(1, 1, 0, 0)},
      {Box{{1, 2, 3}}, {0, -5, 0}, Quaternionf(1, 0, 0, 1)},
      {Mesh{*make_mesh(kSquare, kHalves)}, {2, 0, 0}, Quaternionf(0, 0, 1, 0)}};
  const auto compound = *make_compound(children);
  EXPECT_TRUE(compound->lower().isApprox(Vector3f(-3.5f, -6, -3), 1e-5f));
  EXPECT_TRUE(compound->upper().isApprox(Vector3f(2, 4, 3), 1e-5f));
  EXPECT_LE(compound->lower().y(), -6);
  EXPECT_GE(compound->upper().z(), 3);
  EXPECT_EQ(compound->children().size(), 4u);
}

}  // namespace
}  // namespace carom::test
