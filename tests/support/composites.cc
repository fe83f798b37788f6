#include "tests/support/composites.h"

#include <cmath>

#include "carom/shapes/scaled.h"

namespace carom::test {

Mesh mesh_of(const std::vector<Eigen::Vector3f>& vertices, const Triangles& triangles,
             const MeshRules& rules) {
  return {*make_mesh(vertices, triangles, rules)};
}

Compound compound_of(const std::vector<CompoundChild>& children) {
  return {*make_compound(children)};
}

Mesh flat_grid(int n, float side, const MeshRules& rules) {
  return grid_mesh(
      n, side, [](float, float) { return 0.0f; }, rules);
}

Eigen::Vector3f Composites::scale() {
  const bool is_uniform = scales_.chance(0.4);
  Eigen::Vector3f factors;
  for (int axis = 0; axis < 3; ++axis) {
    factors[axis] = static_cast<float>(scales_.uniform(0.7, 1.4));
    if (is_uniform) factors[axis] = factors[0];
  }
  for (float& factor : factors) factor = scales_.chance(0.2) ? -factor : factor;
  return factors;
}

Mesh Composites::mesh(double size, size_t most_triangles) {
  const Mesh mesh = mesh_without_scale(size, most_triangles);
  return scales_.chance(0.25) ? Mesh{*scaled(mesh.geometry, scale())} : mesh;
}

HeightField Composites::height_field(double size) {
  const HeightField field = field_without_scale(size);
  return scales_.chance(0.25) ? HeightField{*scaled(field.geometry, scale())} : field;
}

Mesh Composites::mesh_without_scale(double size, size_t most_triangles) {
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

HeightField Composites::field_without_scale(double size) {
  const auto nx = static_cast<uint32_t>(2 + random_.below(3));
  const auto ny = static_cast<uint32_t>(2 + random_.below(3));
  const double steps = random_.chance(0.3) ? 0 : 2000, holes = random_.chance(0.5) ? 0 : 0.15;
  const bool is_int16 = random_.chance(0.3);
  const auto scale = static_cast<float>(size / 10000);
  std::vector<float> heights;
  std::vector<int16_t> samples;
  for (uint32_t i = 0; i < nx * ny; ++i) {
    const auto sample = static_cast<int16_t>(random_.uniform(-steps, steps));
    const bool is_hole = random_.chance(holes);
    samples.push_back(is_hole ? kHoleSample : sample);
    heights.push_back(is_hole ? std::numeric_limits<float>::quiet_NaN() : sample * scale);
  }
  HeightGrid grid{.nx = nx,
                  .ny = ny,
                  .dx = static_cast<float>(size * random_.uniform(0.7, 2) / (nx - 1)),
                  .dy = static_cast<float>(size * random_.uniform(0.7, 2) / (ny - 1)),
                  .samples = {.data = heights.data()},
                  .scale = scale};
  if (is_int16) grid.samples = {.data = samples.data(), .type = HeightType::int16};
  return {*make_height_field(grid)};
}

// Children are turned: factors of one magnitude do not shear them.
Compound Composites::compound(double size, size_t most_children) {
  const Compound compound = compound_of_many(size, 1 + random_.below(most_children));
  if (!scales_.chance(0.2)) return compound;
  const Eigen::Vector3f factors = scale();
  return {*scaled(compound.geometry, std::abs(factors.x()) * factors.cwiseSign())};
}

Compound Composites::compound_of_many(double size, size_t count) {
  std::vector<CompoundChild> children(count);
  for (CompoundChild& child : children) {
    child.shape = child_shape(size * random_.uniform(0.2, 0.6));
    child.position = (random_.direction() * random_.uniform(0, size)).cast<float>();
    child.orientation = orientation();
  }
  return compound_of(children);
}

Shape Composites::shape(ShapeKind kind, double size) {
  if (kind == ShapeKind::mesh) return mesh(size);
  if (kind == ShapeKind::height_field) return height_field(size);
  if (kind == ShapeKind::compound) return compound(size);
  return simple(kind, size);
}

TestPair Composites::pair(ShapeKind a, ShapeKind b, PositionType positions, double size,
                          double distance) {
  TestPair pair;
  pair.a = {shape(a, size), stored(random_.direction() * distance, positions), orientation()};
  pair.b = {shape(b, size * random_.uniform(0.3, 1)), pair.a.position, orientation()};
  const double reach = size * random_.uniform(0, random_.chance(0.2) ? 5 : 1.7);
  pair.b.position = stored(pair.b.position + random_.direction() * reach, positions);
  return pair;
}

Shape Composites::child_shape(double size) {
  static constexpr ShapeKind kKinds[] = {ShapeKind::sphere, ShapeKind::capsule, ShapeKind::aabb,
                                         ShapeKind::box,    ShapeKind::dop,     ShapeKind::hull,
                                         ShapeKind::mesh,   ShapeKind::triangle};
  const ShapeKind kind = kKinds[random_.below(std::size(kKinds))];
  return kind == ShapeKind::mesh ? Shape(mesh(size, 6)) : simple(kind, size);
}

std::vector<std::array<ShapeKind, 2>> composite_kind_pairs() {
  std::vector<std::array<ShapeKind, 2>> all;
  for (const ShapeKind a : kEveryKind) {
    for (const ShapeKind b : kEveryKind) {
      if (is_composite(a) || is_composite(b)) all.push_back({a, b});
    }
  }
  return all;
}

std::vector<SubShapes> run_sub_shapes(std::span<const TestPair> pairs, const Call& call) {
  const LaidOut a(side_a(pairs), call.layout_a);
  const LaidOut b(side_b(pairs), call.layout_b);
  Columns columns(pairs.size());
  std::vector<uint32_t> sub_a(pairs.size(), 77), sub_b(pairs.size(), 77);
  ResultColumns out = columns.out();
  out.sub_a = sub_a.data();
  out.sub_b = sub_b.data();
  expect_success(
      call, [&] { return collide_rows(a.view(), b.view(), call.detail, out, options_of(call)); });
  std::vector<SubShapes> all;
  for (size_t i = 0; i < pairs.size(); ++i) all.push_back({sub_a[i], sub_b[i]});
  return all;
}

std::vector<SubShapes> expected_sub_shapes(std::span<const TestPair> pairs,
                                           PositionType positions) {
  std::vector<SubShapes> all;
  for (const TestPair& pair : pairs) {
    const reference::PairResult result = reference_result(pair, positions);
    all.push_back({result.sub_a, result.sub_b});
  }
  return all;
}

void expect_reference(std::span<const TestPair> pairs, const Call& call) {
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
