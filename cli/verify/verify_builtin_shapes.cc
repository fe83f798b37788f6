#include "cli/verify/verify_builtin_shapes.h"

#include <array>
#include <utility>

#include "carom/hulls/build_hull.h"
#include "carom/shapes/compound_geometry.h"
#include "carom/shapes/mesh_geometry.h"

namespace carom::cli {
namespace {

constexpr std::array kDopKinds = {DopKind::k6, DopKind::k14, DopKind::k18, DopKind::k26};

// A cube with its corners cut off.
Dop even_dop(float size) {
  Dop dop{.kind = DopKind::k14};
  dop.lower.fill(-size);
  dop.upper.fill(size);
  return dop;
}

// Returns an invalid hull if none can be built.
Hull hull_of(const std::vector<Eigen::Vector3f>& points) {
  Result<BuiltHull> hull = build_hull(points);
  return hull ? Hull{std::move(hull->geometry)} : Hull{};
}

Mesh mesh_of(const std::vector<Eigen::Vector3f>& vertices,
             const std::vector<std::array<uint32_t, 3>>& triangles, const MeshRules& rules) {
  auto mesh = make_mesh(vertices, triangles, rules);
  return mesh ? Mesh{std::move(*mesh)} : Mesh{};
}

Compound compound_of(const std::vector<CompoundChild>& children) {
  auto compound = make_compound(children);
  return compound ? Compound{std::move(*compound)} : Compound{};
}

Hull even_hull(float size) {
  std::vector<Eigen::Vector3f> corners;
  corners.reserve(8);
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back(i & 1 ? size : -size, i & 2 ? size : -size, i & 4 ? size : -size);
  }
  return hull_of(corners);
}

Hull rounded(Hull hull, float rounding) {
  hull.rounding = rounding;
  return hull;
}

}  // namespace

Shape even_shape(ShapeKind kind, float size) {
  const Eigen::Vector3f x(size, 0, 0);
  const Eigen::Vector3f y(0, size, 0);
  switch (kind) {
    case ShapeKind::capsule:
      return Capsule{-x, x, size};
    case ShapeKind::aabb:
      return Aabb::from_half_extents(Eigen::Vector3f::Constant(size));
    case ShapeKind::box:
      return Box{Eigen::Vector3f::Constant(size)};
    case ShapeKind::rounded_box:
      return Box{Eigen::Vector3f::Constant(size), size};
    case ShapeKind::triangle:
      return Triangle{{x, y - x, -y - x}, size < 0 ? size : 0, false, 0};
    case ShapeKind::halfspace:
      return Halfspace{Eigen::Vector3f::Constant(size), size};
    case ShapeKind::cylinder:
      return Cylinder{size, size};
    case ShapeKind::cone:
      return Cone{size, size};
    case ShapeKind::ellipsoid:
      return Ellipsoid{Eigen::Vector3f::Constant(size)};
    case ShapeKind::dop:
      return even_dop(size);
    case ShapeKind::hull:
      return even_hull(size);
    case ShapeKind::rounded_hull:
      return rounded(even_hull(size), size);
    case ShapeKind::mesh:
      return mesh_of({x, y, -x, -y}, {{0, 1, 2}, {2, 3, 0}},
                     {.one_sided = false, .thickness = size < 0 ? size : 0});
    case ShapeKind::compound:
      return compound_of({{Sphere{size}, x, Eigen::Quaternionf::Identity()},
                          {Box{Eigen::Vector3f::Constant(size)}, -x, {1, 0, 0, 1}}});
    default:
      return Sphere{size};
  }
}

Eigen::Vector3d RandomShapes::in_ball(double radius) {
  const io::Vec3 v = random_.in_ball(radius);
  return {v[0], v[1], v[2]};
}

Eigen::Quaternionf RandomShapes::orientation() {
  const double length = one_of(4) ? 1 : lengths_.draw(random_);
  const auto number = [&] { return static_cast<float>(length * random_.between(-1, 1)); };
  const float x = number(), y = number(), z = number(), w = number();
  return {w, x, y, z};
}

// Each of the three extents is sometimes 0.
Eigen::Vector3f RandomShapes::half_extents(double size) {
  const auto edge = [&] {
    return one_of(16) ? 0 : static_cast<float>(size * random_.between(0.3, 1));
  };
  const float x = edge(), y = edge(), z = edge();
  return {x, y, z};
}

Shape RandomShapes::shape(ShapeKind kind, double size) {
  switch (kind) {
    case ShapeKind::capsule:
      return capsule(size);
    case ShapeKind::aabb: {
      const Eigen::Vector3f lower = -half_extents(size);
      return Aabb{lower, half_extents(size)};
    }
    case ShapeKind::box:
      return Box{half_extents(size)};
    case ShapeKind::rounded_box: {
      const Eigen::Vector3f half = half_extents(size);
      return Box{half, some_rounding(size)};
    }
    case ShapeKind::triangle:
      return triangle(size);
    case ShapeKind::halfspace:
      return halfspace(size);
    case ShapeKind::cylinder: {
      const Eigen::Vector3f half = half_extents(size);
      return Cylinder{half.x(), half.z(), rounding(size)};
    }
    case ShapeKind::cone: {
      const Eigen::Vector3f half = half_extents(size);
      return Cone{half.x(), half.z(), rounding(size)};
    }
    case ShapeKind::ellipsoid: {
      const Eigen::Vector3f half = half_extents(size);
      return Ellipsoid{half, rounding(size)};
    }
    case ShapeKind::dop:
      return dop(size);
    case ShapeKind::hull:
      return hull(size);
    case ShapeKind::rounded_hull:
      return rounded(hull(size), some_rounding(size));
    case ShapeKind::mesh:
      return mesh(size);
    case ShapeKind::compound:
      return compound(size);
    default:
      return Sphere{static_cast<float>(size)};
  }
}

Capsule RandomShapes::capsule(double size) {
  Capsule capsule;
  capsule.a = point(size);
  capsule.b = one_of(8) ? capsule.a : point(size);
  capsule.radius = one_of(8) ? 0 : up_to(0.5 * size);
  return capsule;
}

std::vector<Eigen::Vector3f> RandomShapes::some_points(size_t count, double size) {
  std::vector<Eigen::Vector3f> points(count);
  for (Eigen::Vector3f& p : points) p = point(size);
  return points;
}

// The k-DOP of one or more points.
Dop RandomShapes::dop(double size) {
  const std::vector<Eigen::Vector3f> points = some_points(1 + random_.below(12), size);
  return Dop::of_points(points, kDopKinds[random_.below(kDopKinds.size())]);
}

// The hull of one or more points, sometimes flat.
Hull RandomShapes::hull(double size) {
  std::vector<Eigen::Vector3f> points = some_points(1 + random_.below(20), size);
  if (one_of(8)) {
    for (Eigen::Vector3f& p : points) p.z() = 0;
  }
  return hull_of(points);
}

// A strip of triangles that share edges.
Mesh RandomShapes::mesh(double size) {
  const std::vector<Eigen::Vector3f> vertices = some_points(4 + random_.below(4), size);
  std::vector<std::array<uint32_t, 3>> triangles;
  for (uint32_t i = 0; i + 2 < vertices.size(); ++i) {
    triangles.push_back({i + i % 2, i + 1 - i % 2, i + 2});
  }
  if (one_of(8)) triangles[0][1] = triangles[0][0];
  const float thickness = one_of(4) ? up_to(0.5 * size) : 0;
  return mesh_of(vertices, triangles, {.one_sided = one_of(4), .thickness = thickness});
}

Compound RandomShapes::compound(double size) {
  constexpr std::array kParts = {
      ShapeKind::sphere,      ShapeKind::capsule, ShapeKind::aabb,      ShapeKind::box,
      ShapeKind::dop,         ShapeKind::hull,    ShapeKind::mesh,      ShapeKind::triangle,
      ShapeKind::cylinder,    ShapeKind::cone,    ShapeKind::ellipsoid, ShapeKind::rounded_box,
      ShapeKind::rounded_hull};
  std::vector<CompoundChild> children(1 + random_.below(3));
  for (CompoundChild& child : children) {
    child.shape = shape(kParts[random_.below(kParts.size())], size / 2);
    child.position = point(size / 2);
    child.orientation = orientation();
  }
  return compound_of(children);
}

Triangle RandomShapes::triangle(double size) {
  Triangle triangle;
  for (Eigen::Vector3f& corner : triangle.corners) corner = point(size);
  if (one_of(16)) triangle.corners[2] = triangle.corners[0];
  triangle.thickness = one_of(4) ? up_to(0.5 * size) : 0;
  triangle.one_sided = one_of(4);
  triangle.inner_edges = static_cast<uint8_t>(one_of(2) ? random_.below(8) : 0);
  return triangle;
}

Halfspace RandomShapes::halfspace(double size) {
  Halfspace halfspace;
  halfspace.normal = point(1);
  halfspace.offset = static_cast<float>(size * random_.between(-1, 1));
  return halfspace;
}

}  // namespace carom::cli
