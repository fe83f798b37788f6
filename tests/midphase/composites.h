// Random meshes and compounds, pairs with them, and checks of their rows and sub-shapes against the
// reference.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "carom/narrowphase/collide.h"
#include "carom/shapes/compound_geometry.h"
#include "carom/shapes/mesh_geometry.h"
#include "oracle/convex_random.h"
#include "tests/support/isas.h"
#include "tests/support/run.h"

namespace carom::test {

using Triangles = std::vector<std::array<uint32_t, 3>>;

inline Mesh mesh_of(const std::vector<Eigen::Vector3f>& vertices, const Triangles& triangles,
                    const MeshRules& rules = {}) {
  return {*make_mesh(vertices, triangles, rules)};
}

inline Compound compound_of(const std::vector<CompoundChild>& children) {
  return {*make_compound(children)};
}

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

inline Mesh flat_grid(int n, float side, const MeshRules& rules = {}) {
  return grid_mesh(
      n, side, [](float, float) { return 0.0f; }, rules);
}

class Composites {
 public:
  explicit Composites(uint64_t seed) : random_(seed), shapes_({}, random_) {}

  oracle::Random& random() { return random_; }

  // A random set of triangles, some without area, or a terrain; about `size` large.
  Mesh mesh(double size, size_t most_triangles = 24) {
    const MeshRules rules = {
        .one_sided = random_.chance(0.2),
        .thickness = random_.chance(0.2) ? static_cast<float>(size * random_.uniform(0, 0.3)) : 0};
    if (random_.chance(0.5)) {
      const int n = 1 + static_cast<int>(random_.below(3));
      const double bumps = random_.chance(0.5) ? 0 : 0.2 * size;
      return grid_mesh(
          n, static_cast<float>(2 * size / n),
          [&](float, float) { return random_.uniform(-bumps, bumps); }, rules);
    }
    std::vector<Eigen::Vector3f> vertices;
    for (size_t i = 0; i < 3 + most_triangles / 2; ++i) {
      vertices.push_back((random_.direction() * random_.uniform(0, size)).cast<float>());
    }
    Triangles triangles(1 + random_.below(most_triangles));
    for (auto& triangle : triangles) {
      for (uint32_t& corner : triangle) {
        corner = static_cast<uint32_t>(random_.below(vertices.size()));
      }
    }
    return mesh_of(vertices, triangles, rules);
  }

  Compound compound(double size, size_t most_children = 6) {
    std::vector<CompoundChild> children(1 + random_.below(most_children));
    for (CompoundChild& child : children) {
      child.shape = child_shape(size * random_.uniform(0.2, 0.6));
      child.position = (random_.direction() * random_.uniform(0, size)).cast<float>();
      child.orientation = orientation();
    }
    return compound_of(children);
  }

  Shape simple(ShapeKind kind, double size) { return shapes_.shape(kind, size); }

  Shape shape(ShapeKind kind, double size) {
    if (kind == ShapeKind::mesh) return mesh(size);
    if (kind == ShapeKind::compound) return compound(size);
    return simple(kind, size);
  }

  Eigen::Quaternionf orientation() { return shapes_.orientation(); }

  // Two bodies, of which about half of the pairs overlap.
  TestPair pair(ShapeKind a, ShapeKind b, PositionType positions, double size, double distance) {
    TestPair pair;
    pair.a = {shape(a, size), stored(random_.direction() * distance, positions), orientation()};
    pair.b = {shape(b, size * random_.uniform(0.3, 1)), pair.a.position, orientation()};
    const double reach = size * random_.uniform(0, random_.chance(0.2) ? 5 : 1.7);
    pair.b.position = stored(pair.b.position + random_.direction() * reach, positions);
    return pair;
  }

 private:
  Shape child_shape(double size) {
    static constexpr ShapeKind kKinds[] = {ShapeKind::sphere, ShapeKind::capsule, ShapeKind::aabb,
                                           ShapeKind::box,    ShapeKind::dop,     ShapeKind::hull,
                                           ShapeKind::mesh,   ShapeKind::triangle};
    const ShapeKind kind = kKinds[random_.below(std::size(kKinds))];
    return kind == ShapeKind::mesh ? Shape(mesh(size, 6)) : simple(kind, size);
  }

  oracle::Random random_;
  oracle::ConvexRandom shapes_;
};

inline constexpr ShapeKind kEveryKind[] = {
    ShapeKind::sphere,    ShapeKind::capsule, ShapeKind::aabb, ShapeKind::box,
    ShapeKind::dop,       ShapeKind::hull,    ShapeKind::mesh, ShapeKind::compound,
    ShapeKind::halfspace, ShapeKind::triangle};

// All ordered pairs of kinds of which one is a mesh or a compound.
inline std::vector<std::array<ShapeKind, 2>> composite_kind_pairs() {
  std::vector<std::array<ShapeKind, 2>> all;
  for (const ShapeKind a : kEveryKind) {
    for (const ShapeKind b : kEveryKind) {
      if (is_composite(a) || is_composite(b)) all.push_back({a, b});
    }
  }
  return all;
}

using SubShapes = std::array<uint32_t, 2>;

// The sub-shapes that a call writes.
inline std::vector<SubShapes> run_sub_shapes(std::span<const TestPair> pairs, const Call& call) {
  const LaidOut a(side_a(pairs), call.layout_a);
  const LaidOut b(side_b(pairs), call.layout_b);
  Columns columns(pairs.size());
  std::vector<uint32_t> sub_a(pairs.size(), 77), sub_b(pairs.size(), 77);
  ResultColumns out = columns.out();
  out.sub_a = sub_a.data();
  out.sub_b = sub_b.data();
  expect_success(call, [&] {
    return collide_rows(a.view(), b.view(), call.detail, out, call.frame, call.parallelism,
                        call.measured, call.accuracy);
  });
  std::vector<SubShapes> all;
  for (size_t i = 0; i < pairs.size(); ++i) all.push_back({sub_a[i], sub_b[i]});
  return all;
}

inline std::vector<SubShapes> expected_sub_shapes(std::span<const TestPair> pairs,
                                                  PositionType positions) {
  std::vector<SubShapes> all;
  for (const TestPair& pair : pairs) {
    const reference::PairResult result = reference_result(pair, positions);
    all.push_back({result.sub_a, result.sub_b});
  }
  return all;
}

// Rows (from both ways to call) and sub-shapes equal those of the reference, on every ISA.
inline void expect_reference(std::span<const TestPair> pairs, const Call& call) {
  const PositionType positions = call.layout_a.positions;
  const std::vector<Row> expected = expected_rows(pairs, positions, call.detail, call.frame);
  const std::vector<SubShapes> sub_shapes = expected_sub_shapes(pairs, positions);
  for_each_isa([&] {
    EXPECT_TRUE(same_rows(expected, run_rows(pairs, call), pairs));
    EXPECT_TRUE(same_rows(expected, run_list(pairs, call), pairs));
    if (has_contacts(call.detail)) {
      EXPECT_EQ(sub_shapes, run_sub_shapes(pairs, call));
    }
  });
}

}  // namespace carom::test
