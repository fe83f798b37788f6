#include "cli/shapes.h"

#include <array>
#include <cstdio>

#include "io/file.h"

namespace carom::cli {
namespace {

Error shape_error(const std::string& source, size_t index, const std::string& text) {
  return io::file_error(source, "shape_kind: shape " + std::to_string(index) + " is " + text);
}

Error no_kernel(const std::string& source, size_t index, ShapeKind kind) {
  return shape_error(source, index,
                     std::string("a ") + name(kind) + ", which this version has no kernel for");
}

Eigen::Vector3f vector(const float* xyz) { return Eigen::Map<const Eigen::Vector3f>(xyz); }

// The triangle's indices are relative to the mesh's vertices.
Triangle only_triangle(const io::SceneShapes& shapes, size_t index) {
  const std::array<float, 8>& params = shapes.params[index];
  const std::array<uint32_t, 3>& indices = shapes.triangles[shapes.triangle_range[index][0]];
  Triangle triangle;
  for (size_t corner = 0; corner < 3; ++corner) {
    size_t vertex = size_t{shapes.vertex_range[index][0]} + indices[corner];
    triangle.corners[corner] = vector(shapes.vertices[vertex].data());
  }
  triangle.one_sided = params[0] != 0;
  triangle.thickness = params[1];
  return triangle;
}

Result<Shape> convert_mesh(const io::SceneShapes& shapes, size_t index, const std::string& source) {
  uint32_t triangles = shapes.triangle_range[index][1];
  if (triangles == 1) return Shape(only_triangle(shapes, index));
  return shape_error(source, index,
                     "a mesh of " + std::to_string(triangles) +
                         " triangles; this version has kernels for meshes of one triangle only");
}

// Of the shape's own vertices.
Result<Shape> convert_dop(const io::SceneShapes& shapes, size_t index, const std::string& source) {
  const float k = shapes.params[index][0];
  const auto [first, count] = shapes.vertex_range[index];
  if (count == 0) return shape_error(source, index, "a dop without vertices");
  std::vector<Eigen::Vector3f> points;
  points.reserve(count);
  for (size_t i = first; i < size_t{first} + count; ++i) {
    points.push_back(vector(shapes.vertices[i].data()));
  }
  for (const DopKind kind : {DopKind::k6, DopKind::k14, DopKind::k18, DopKind::k26}) {
    if (k == static_cast<float>(kind)) return Shape(Dop::of_points(points, kind));
  }
  char number[32];
  std::snprintf(number, sizeof number, "%g", double{k});
  return shape_error(source, index,
                     std::string("a dop of k = ") + number + " (6, 14, 18 or 26 was expected)");
}

Result<Shape> convert_shape(const io::SceneShapes& shapes, size_t index,
                            const std::string& source) {
  const std::array<float, 8>& params = shapes.params[index];
  auto kind = static_cast<ShapeKind>(shapes.kind[index]);
  switch (kind) {
    case ShapeKind::sphere:
      return Shape(Sphere{params[0]});
    case ShapeKind::capsule:
      return Shape(Capsule{vector(&params[0]), vector(&params[3]), params[6]});
    case ShapeKind::aabb:
      return Shape(Aabb::from_half_extents(vector(&params[0])));
    case ShapeKind::box:
      return Shape(Box{vector(&params[0])});
    case ShapeKind::dop:
      return convert_dop(shapes, index, source);
    case ShapeKind::mesh:
      return convert_mesh(shapes, index, source);
    case ShapeKind::halfspace:
      return Shape(Halfspace{vector(&params[0]), params[3]});
    default:
      return no_kernel(source, index, kind);
  }
}

}  // namespace

Result<std::vector<Shape>> convert_shapes(const io::SceneShapes& shapes,
                                          const std::string& source) {
  std::vector<Shape> converted;
  converted.reserve(shapes.kind.size());
  for (size_t i = 0; i < shapes.kind.size(); ++i) {
    Result<Shape> shape = convert_shape(shapes, i, source);
    if (!shape) return shape.error();
    converted.push_back(*shape);
  }
  return converted;
}

}  // namespace carom::cli
