// Random meshes and compounds, pairs with them, and checks of their rows and sub-shapes against the
// reference.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "carom/narrowphase/collide.h"
#include "carom/shapes/compound_geometry.h"
#include "carom/shapes/height_field_geometry.h"
#include "carom/shapes/mesh_geometry.h"
#include "oracle/convex_random.h"
#include "tests/support/isas.h"
#include "tests/support/run.h"

namespace carom::test {

using Triangles = std::vector<std::array<uint32_t, 3>>;

Mesh mesh_of(const std::vector<Eigen::Vector3f>& vertices, const Triangles& triangles,
             const MeshRules& rules = {});

Compound compound_of(const std::vector<CompoundChild>& children);

// n x n squares about the origin, each of two triangles; `height` gives the z of every corner.
template <class Height>
Mesh grid_mesh(int n, float side, const Height& height, const MeshRules& rules = {}) {
  std::vector<Eigen::Vector3f> vertices;
  Triangles triangles;
  const auto at = [n](int i, int j) { return static_cast<uint32_t>(i * (n + 1) + j); };
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const float x = (float(i) - float(n) / 2) * side, y = (float(j) - float(n) / 2) * side;
      vertices.push_back({x, y, static_cast<float>(height(x, y))});
      if (i == n || j == n) continue;
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh_of(vertices, triangles, rules);
}

Mesh flat_grid(int n, float side, const MeshRules& rules = {});

class Composites {
 public:
  explicit Composites(uint64_t seed) : random_(seed), scales_(seed + 1000), shapes_({}, random_) {}

  oracle::Random& random() { return random_; }

  // Factors of about 1, often of one magnitude; a third of them mirror.
  Eigen::Vector3f scale();

  // A random set of triangles, some without area, or a terrain; about `size` large. A quarter have
  // a scale.
  Mesh mesh(double size, size_t most_triangles = 24);

  // A few cells of either type of sample, some of them holes; about `size` large. A quarter have a
  // scale.
  HeightField height_field(double size);

  // A fifth have a scale.
  Compound compound(double size, size_t most_children = 6);

  Compound compound_of_many(double size, size_t count);

  Shape simple(ShapeKind kind, double size) { return shapes_.shape(kind, size); }

  Shape shape(ShapeKind kind, double size);

  Eigen::Quaternionf orientation() { return shapes_.orientation(); }

  // Two bodies, of which about half of the pairs overlap.
  TestPair pair(ShapeKind a, ShapeKind b, PositionType positions, double size, double distance);

 private:
  Mesh mesh_without_scale(double size, size_t most_triangles);
  HeightField field_without_scale(double size);
  Shape child_shape(double size);

  oracle::Random random_;
  oracle::Random scales_;
  oracle::ConvexRandom shapes_;
};

inline constexpr ShapeKind kEveryKind[] = {
    ShapeKind::sphere,    ShapeKind::capsule,   ShapeKind::aabb,         ShapeKind::box,
    ShapeKind::dop,       ShapeKind::hull,      ShapeKind::mesh,         ShapeKind::compound,
    ShapeKind::halfspace, ShapeKind::triangle,  ShapeKind::height_field, ShapeKind::cylinder,
    ShapeKind::cone,      ShapeKind::ellipsoid, ShapeKind::rounded_box,  ShapeKind::rounded_hull};

// All ordered pairs of kinds of which one is a mesh or a compound.
std::vector<std::array<ShapeKind, 2>> composite_kind_pairs();

using SubShapes = std::array<uint32_t, 2>;

// The sub-shapes that a call writes.
std::vector<SubShapes> run_sub_shapes(std::span<const TestPair> pairs, const Call& call);

std::vector<SubShapes> expected_sub_shapes(std::span<const TestPair> pairs, PositionType positions);

// Rows (from both ways to call) and sub-shapes equal those of the reference, on every ISA.
void expect_reference(std::span<const TestPair> pairs, const Call& call);

}  // namespace carom::test
