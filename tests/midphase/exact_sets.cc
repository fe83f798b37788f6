#include "tests/midphase/exact_sets.h"

namespace carom::test {

ExactPair ExactSets::next(ShapeKind kind_a, ShapeKind kind_b) {
  static constexpr double kSizes[] = {1, 1e-3, 1e4};
  static constexpr double kDistances[] = {0, 1e3, 1e6};
  const double size = kSizes[random_.below(3)];
  TestPair pair;
  pair.a.shape = shape(kind_a, size, true);
  const bool is_small = random_.chance(0.2);
  const double size_b =
      size * (is_small ? random_.log_uniform(0.01, 0.2) : random_.uniform(0.2, 0.9));
  pair.b.shape = shape(kind_b, size_b, false);
  pair.a.orientation = shapes_.orientation();
  pair.b.orientation = shapes_.orientation();
  pair.a.position = random_.direction() * size * kDistances[random_.below(3)];
  CompositeOracle oracle = place(pair, size);
  return random_.chance(0.5) ? ExactPair(swapped(pair)) : ExactPair(pair, std::move(oracle));
}

CompositeOracle ExactSets::place(TestPair& pair, double size) {
  const Eigen::Vector3d direction = random_.direction();
  const bool is_anywhere = random_.chance(0.25);
  const double reach = size * (is_anywhere ? random_.uniform(0, 1.5) : random_.uniform(0.5, 3));
  pair.b.position = pair.a.position + direction * reach;
  CompositeOracle oracle(pair);
  if (is_anywhere) return oracle;
  double gap =
      size * (random_.chance(0.3) ? random_.uniform(0, 0.3) : random_.log_uniform(1e-10, 1e-4));
  if (random_.chance(0.5)) gap = -gap;
  ExactSeparations exact = oracle.separations();
  if (exact.all <= 0) {
    pair.b.position = pair.a.position + direction * (6 * size);
    oracle.place_b(pair);
    exact = oracle.separations();
  }
  // Moving along the normal leaves all other parts at least that far apart.
  const auto way = static_cast<double>(gap - exact.all);
  const auto& n = exact.normal;
  pair.b.position += Eigen::Vector3d(double(n.x), double(n.y), double(n.z)) * way;
  oracle.place_b(pair);
  return oracle;
}

Shape ExactSets::shape(ShapeKind kind, double size, bool is_large) {
  if (kind == ShapeKind::mesh) return mesh(size, is_large ? 9 : 5);
  if (kind == ShapeKind::compound) return compound(size);
  return (random_.chance(0.2) ? slender_ : shapes_).shape(kind, size);
}

Mesh ExactSets::mesh(double size, int most) {
  const double thickness = random_.chance(0.3) ? size * random_.uniform(0.02, 0.2) : 0;
  const MeshRules rules = {.one_sided = false, .thickness = static_cast<float>(thickness)};
  const int n = shapes_.integer(most / 2 + 1, most);
  const Mesh whole = random_.chance(0.5) ? terrain(size, n, rules) : globe(size, n, rules);
  return random_.chance(0.4) ? shattered(whole) : whole;
}

Mesh ExactSets::terrain(double size, int n, const MeshRules& rules) {
  const double bumps = random_.chance(0.2) ? 0 : size * random_.uniform(0, 0.2);
  return grid_mesh(
      n, static_cast<float>(2 * size / n),
      [&](float, float) { return random_.uniform(-bumps, bumps); }, rules);
}

Mesh ExactSets::globe(double size, int n, const MeshRules& rules) {
  const double bumps = random_.chance(0.5) ? 0 : 0.15;
  const auto corners = static_cast<uint32_t>(n + 2), rings = static_cast<uint32_t>(n - 1);
  std::vector<Eigen::Vector3f> vertices;
  const auto add = [&](double height, double angle) {
    const double r = size * random_.uniform(1 - bumps, 1);
    const Eigen::Vector3d p(std::sin(height) * std::cos(angle), std::sin(height) * std::sin(angle),
                            std::cos(height));
    vertices.push_back((r * p).cast<float>());
  };
  for (uint32_t ring = 0; ring < rings; ++ring) {
    for (uint32_t i = 0; i < corners; ++i) {
      add(std::numbers::pi * (ring + 1) / n, 2 * std::numbers::pi * i / corners);
    }
  }
  add(0, 0);
  add(std::numbers::pi, 0);
  const uint32_t top = rings * corners, bottom = top + 1;
  Triangles triangles;
  for (uint32_t i = 0; i < corners; ++i) {
    const uint32_t j = (i + 1) % corners;
    triangles.push_back({top, i, j});
    for (uint32_t upper = 0; upper + corners < top; upper += corners) {
      const uint32_t lower = upper + corners;
      triangles.push_back({upper + i, lower + i, lower + j});
      triangles.push_back({upper + i, lower + j, upper + j});
    }
    triangles.push_back({bottom, top - corners + j, top - corners + i});
  }
  return mesh_of(vertices, triangles, rules);
}

Mesh ExactSets::shattered(const Mesh& mesh) {
  std::vector<Eigen::Vector3f> vertices;
  Triangles triangles;
  for (size_t i = 0; i < mesh.geometry->triangles().size(); ++i) {
    const auto corners = mesh.geometry->corners(i);
    Eigen::Vector3f middle = Eigen::Vector3f::Zero();
    for (const Eigen::Vector3f& corner : corners) middle += corner / 3;
    const auto first = static_cast<uint32_t>(vertices.size());
    triangles.push_back({first, first + 1, first + 2});
    for (const Eigen::Vector3f& corner : corners) {
      vertices.push_back(middle + 0.95f * (corner - middle));
    }
  }
  return mesh_of(vertices, triangles, mesh.geometry->rules());
}

Compound ExactSets::compound(double size) {
  std::vector<CompoundChild> children(1 + random_.below(8));
  for (CompoundChild& child : children) {
    child.shape = child_shape(size * random_.uniform(0.1, 0.6));
    child.position = (random_.direction() * random_.uniform(0, size)).cast<float>();
    child.orientation = shapes_.orientation();
  }
  return compound_of(children);
}

Shape ExactSets::child_shape(double size) {
  static constexpr ShapeKind kKinds[] = {ShapeKind::sphere, ShapeKind::capsule, ShapeKind::box,
                                         ShapeKind::hull,   ShapeKind::mesh,    ShapeKind::aabb};
  const ShapeKind kind = kKinds[random_.below(std::size(kKinds))];
  if (kind != ShapeKind::aabb) return shape(kind, size, false);
  const auto half = std::get<Box>(shapes_.shape(ShapeKind::box, size)).half;
  return Aabb::from_half_extents(half);
}

}  // namespace carom::test
