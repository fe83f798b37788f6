#include "cli/scenes/shapes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>
#include <iterator>
#include <map>
#include <tuple>
#include <utility>

#include "carom/base/function_ref.h"
#include "carom/hulls/build_hull.h"
#include "carom/shapes/compound_geometry.h"
#include "carom/shapes/height_field_geometry.h"
#include "carom/shapes/mesh_geometry.h"
#include "carom/shapes/scaled.h"
#include "io/files/file.h"

namespace carom::cli {
namespace {

Eigen::Vector3f vector(const float* xyz) { return Eigen::Map<const Eigen::Vector3f>(xyz); }

// Indices are relative to the mesh's own vertices.
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

// The vertices of one shape.
std::vector<Eigen::Vector3f> vertices_of(const io::SceneShapes& shapes, size_t index) {
  const auto [first, count] = shapes.vertex_range[index];
  std::vector<Eigen::Vector3f> points;
  points.reserve(count);
  for (size_t i = first; i < size_t{first} + count; ++i) {
    points.push_back(vector(shapes.vertices[i].data()));
  }
  return points;
}

Result<Shape> convert_mesh(const io::SceneShapes& shapes, size_t index) {
  const auto [first, count] = shapes.triangle_range[index];
  if (count == 0) return Error{"a mesh without triangles"};
  if (count == 1) return Shape(only_triangle(shapes, index));
  const std::array<float, 8>& params = shapes.params[index];
  Result<std::shared_ptr<const MeshGeometry>> mesh =
      make_mesh(vertices_of(shapes, index), std::span(shapes.triangles).subspan(first, count),
                {.one_sided = params[0] != 0, .thickness = params[1]});
  return Shape(mesh ? Mesh{std::move(*mesh)} : Mesh{});
}

Result<Shape> convert_hull(const io::SceneShapes& shapes, size_t index) {
  const std::vector<Eigen::Vector3f> points = vertices_of(shapes, index);
  if (points.empty()) return Error{"a hull without vertices"};
  Result<BuiltHull> hull = build_hull(points);
  return Shape(hull ? Hull{std::move(hull->geometry)} : Hull{});
}

Result<Shape> convert_dop(const io::SceneShapes& shapes, size_t index) {
  const float k = shapes.params[index][0];
  const std::vector<Eigen::Vector3f> points = vertices_of(shapes, index);
  if (points.empty()) return Error{"a dop without vertices"};
  for (const DopKind kind : {DopKind::k6, DopKind::k14, DopKind::k18, DopKind::k26}) {
    if (k == static_cast<float>(kind)) return Shape(Dop::of_points(points, kind));
  }
  char number[32];
  std::snprintf(number, sizeof number, "%g", double{k});
  return Error{std::string("a dop of k = ") + number + " (6, 14, 18 or 26 was expected)"};
}

// The file has as many heights as the grid has samples.
Result<Shape> convert_height_field(const io::SceneShapes& shapes, size_t index) {
  const std::array<float, 8>& params = shapes.params[index];
  Result<std::shared_ptr<HeightFieldGeometry>> field =
      make_height_field({.nx = static_cast<uint32_t>(params[0]),
                         .ny = static_cast<uint32_t>(params[1]),
                         .dx = params[2],
                         .dy = params[3],
                         .samples = {.data = &shapes.heights[shapes.height_range[index][0]]}});
  if (!field) return Error{"not valid: " + field.error().message};
  return Shape(HeightField{std::move(*field)});
}

// `child_of(i)` is shape i, which is no compound.
Result<Shape> convert_compound(const io::SceneShapes& shapes, size_t index,
                               FunctionRef<Result<Shape>(uint32_t)> child_of) {
  const auto [first, count] = shapes.child_range[index];
  if (count == 0) return Error{"a compound without children"};
  std::vector<CompoundChild> children;
  children.reserve(count);
  for (size_t i = first; i < size_t{first} + count; ++i) {
    Result<Shape> child = child_of(shapes.child_shape[i]);
    if (!child) return child.error();
    if (kind_of(*child) == ShapeKind::halfspace) {
      return Error{"a compound with a halfspace as a child"};
    }
    children.push_back({std::move(*child), vector(shapes.child_position[i].data()),
                        Eigen::Quaternionf(shapes.child_orientation[i].data())});
  }
  Result<std::shared_ptr<const CompoundGeometry>> compound = make_compound(children);
  return Shape(compound ? Compound{std::move(*compound)} : Compound{});
}

// The shape without its scale and its rounding. Not a compound.
Result<Shape> convert_before_scale(const io::SceneShapes& shapes, size_t index) {
  const std::array<float, 8>& params = shapes.params[index];
  auto kind = static_cast<ShapeKind>(shapes.kind[index]);
  switch (kind) {
    case ShapeKind::capsule:
      return Shape(Capsule{vector(&params[0]), vector(&params[3]), params[6]});
    case ShapeKind::aabb:
      return Shape(Aabb::from_half_extents(vector(&params[0])));
    case ShapeKind::box:
      return Shape(Box{vector(&params[0])});
    case ShapeKind::dop:
      return convert_dop(shapes, index);
    case ShapeKind::hull:
      return convert_hull(shapes, index);
    case ShapeKind::mesh:
      return convert_mesh(shapes, index);
    case ShapeKind::height_field:
      return convert_height_field(shapes, index);
    case ShapeKind::halfspace:
      return Shape(Halfspace{vector(&params[0]), params[3]});
    case ShapeKind::cylinder:
      return Shape(Cylinder{params[0], params[1]});
    case ShapeKind::cone:
      return Shape(Cone{params[0], params[1]});
    case ShapeKind::ellipsoid:
      return Shape(Ellipsoid{vector(&params[0])});
    default:
      return Shape(Sphere{params[0]});
  }
}

// The set of a shape under its scale, if it has one.
Result<Shape> apply_scale(const io::SceneShapes& shapes, size_t index, Result<Shape> set) {
  if (!set || shapes.scale.empty()) return set;
  const Eigen::Vector3f scale = vector(shapes.scale[index].data());
  if (scale == Eigen::Vector3f::Ones()) return set;
  Result<Shape> result = scaled(*set, scale);
  if (!result) return Error{"not valid with its scale: " + result.error().message};
  return result;
}

void set_rounding(Shape& shape, float rounding) {
  std::visit(
      [rounding](auto& s) {
        if constexpr (requires { s.rounding; }) s.rounding = rounding;
      },
      shape);
}

// A cone that its scale has turned upside down is the child of a compound.
Result<Shape> apply_rounding(const io::SceneShapes& shapes, size_t index, Result<Shape> set) {
  if (!set || shapes.rounding.empty() || shapes.rounding[index] == 0) return set;
  const auto* compound = std::get_if<Compound>(&*set);
  if (!compound) {
    set_rounding(*set, shapes.rounding[index]);
    return set;
  }
  CompoundChild child = compound->geometry->children()[0];
  set_rounding(child.shape, shapes.rounding[index]);
  auto rounded = make_compound(std::span(&child, 1));
  if (!rounded) return rounded.error();
  return Shape(Compound{std::move(*rounded)});
}

// A file scales the set first, then rounds it.
Result<Shape> apply_both(const io::SceneShapes& shapes, size_t index, Result<Shape> set) {
  return apply_rounding(shapes, index, apply_scale(shapes, index, std::move(set)));
}

// Converts shapes that differ in their scale and rounding alone once before these, so that they
// share a geometry.
class Converter {
 public:
  explicit Converter(const io::SceneShapes& shapes) : shapes_(shapes) {}

  Result<Shape> operator()(size_t index) {
    if (shapes_.scale.empty() || is_its_parameters(shapes_.kind[index])) {
      return convert_simple_shape(shapes_, index);
    }
    const auto range = [index](const auto& ranges) {
      return ranges.empty() ? Range{} : ranges[index];
    };
    const Key key = {shapes_.kind[index], bits(shapes_.params[index]), range(shapes_.vertex_range),
                     range(shapes_.triangle_range), range(shapes_.height_range)};
    auto place = known_.find(key);
    if (place == known_.end()) {
      Result<Shape> set = convert_before_scale(shapes_, index);
      if (!set) return set;
      place = known_.emplace(key, std::move(*set)).first;
    }
    return apply_both(shapes_, index, place->second);
  }

 private:
  using Range = std::array<uint32_t, 2>;
  using Key = std::tuple<uint8_t, std::array<uint32_t, 8>, Range, Range, Range>;

  // Parameters may be NaN.
  static std::array<uint32_t, 8> bits(const std::array<float, 8>& params) {
    return std::bit_cast<std::array<uint32_t, 8>>(params);
  }

  const io::SceneShapes& shapes_;
  std::map<Key, Shape> known_;
};

bool is_compound(const io::SceneShapes& shapes, size_t index) {
  return shapes.kind[index] == static_cast<uint8_t>(ShapeKind::compound);
}

Error shape_error(const std::string& source, size_t index, const Error& what) {
  return io::file_error(source,
                        "shape_kind: shape " + std::to_string(index) + " is " + what.message);
}

}  // namespace

bool is_its_parameters(uint8_t kind) {
  constexpr ShapeKind kKinds[] = {ShapeKind::sphere, ShapeKind::capsule,   ShapeKind::aabb,
                                  ShapeKind::box,    ShapeKind::halfspace, ShapeKind::cylinder,
                                  ShapeKind::cone,   ShapeKind::ellipsoid};
  return std::find(std::begin(kKinds), std::end(kKinds), static_cast<ShapeKind>(kind)) !=
         std::end(kKinds);
}

Result<Shape> convert_simple_shape(const io::SceneShapes& shapes, size_t index) {
  return apply_both(shapes, index, convert_before_scale(shapes, index));
}

Result<Shape> convert_shape(const io::SceneShapes& shapes, size_t index) {
  if (!is_compound(shapes, index)) return convert_simple_shape(shapes, index);
  const auto child_of = [&](uint32_t child) { return convert_simple_shape(shapes, child); };
  return apply_scale(shapes, index, convert_compound(shapes, index, child_of));
}

Result<std::vector<Shape>> convert_shapes(const io::SceneShapes& shapes,
                                          const std::string& source) {
  std::vector<Shape> converted(shapes.kind.size(), Compound{});
  Converter convert(shapes);
  for (size_t i = 0; i < converted.size(); ++i) {
    if (is_compound(shapes, i)) continue;
    Result<Shape> shape = convert(i);
    if (!shape) return shape_error(source, i, shape.error());
    converted[i] = std::move(*shape);
  }
  for (size_t i = 0; i < converted.size(); ++i) {
    if (!is_compound(shapes, i)) continue;
    const auto child_of = [&](uint32_t child) -> Result<Shape> { return converted[child]; };
    Result<Shape> shape = apply_scale(shapes, i, convert_compound(shapes, i, child_of));
    if (!shape) return shape_error(source, i, shape.error());
    converted[i] = std::move(*shape);
  }
  return converted;
}

}  // namespace carom::cli
