#include "io/shape_arrays.h"

#include <cfloat>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

#include "carom/shapes/height_field_geometry.h"

namespace carom::io {
namespace {

using Range = std::array<uint32_t, 2>;

// The largest kind in the file format. It has no triangle kind: a lone triangle is a mesh of one.
constexpr uint8_t kLastKind = uint8_t(ShapeKind::height_field);

bool needs_vertices(uint8_t kind) {
  return kind == uint8_t(ShapeKind::dop) || kind == uint8_t(ShapeKind::hull) ||
         kind == uint8_t(ShapeKind::mesh);
}
bool needs_triangles(uint8_t kind) { return kind == uint8_t(ShapeKind::mesh); }
bool needs_children(uint8_t kind) { return kind == uint8_t(ShapeKind::compound); }
bool needs_heights(uint8_t kind) { return kind == uint8_t(ShapeKind::height_field); }

std::string element(size_t i) { return "element " + std::to_string(i) + " "; }

// Reads an array that may be absent, into `out`.
template <class T>
Result<void> read_optional(const NpzReader& reader, const std::string& name, Shape expected,
                           std::vector<T>& out) {
  if (!reader.has(name)) return {};
  Result<std::vector<T>> values = reader.read<T>(name, std::move(expected));
  if (!values) return values.error();
  out = std::move(*values);
  return {};
}

template <class T>
Result<void> write_optional(NpzWriter& writer, const std::string& name,
                            const std::vector<T>& values) {
  if (values.empty()) return {};
  return writer.add(name, values);
}

// The first failure, if any.
Result<void> first_error(std::initializer_list<Result<void>> results) {
  for (const Result<void>& result : results) {
    if (!result) return result;
  }
  return {};
}

Result<void> check_kinds(const SceneShapes& shapes, const std::string& path) {
  for (size_t i = 0; i < shapes.kind.size(); ++i) {
    if (shapes.kind[i] > kLastKind) {
      return member_error(path, "shape_kind",
                          element(i) + "is the unknown kind " + std::to_string(shapes.kind[i]) +
                              " (0 to " + std::to_string(kLastKind) + " was expected)");
    }
  }
  return {};
}

// The largest sum of counts of all ranges into an array of `size` elements. Shapes may share
// elements, but a small file must not cause unbounded work.
uint64_t most_uses(size_t size) { return 64 * (uint64_t{size} + (uint64_t{1} << 20)); }

// Checks that the ranges are there if a kind needs them, that each lies inside its array of `size`
// elements, and that they do not name too many elements together.
Result<void> check_ranges(const SceneShapes& shapes, const std::string& path,
                          const std::string& name, const std::vector<Range>& ranges, size_t size,
                          bool (*needed)(uint8_t)) {
  if (ranges.empty()) {
    for (size_t i = 0; i < shapes.kind.size(); ++i) {
      if (!needed(shapes.kind[i])) continue;
      return member_error(path, name,
                          "is missing (shape " + std::to_string(i) + " of kind " +
                              std::to_string(shapes.kind[i]) + " needs it)");
    }
    return {};
  }
  uint64_t uses = 0;
  for (size_t i = 0; i < ranges.size(); ++i) {
    const auto [first, count] = ranges[i];
    uses += count;
    if (uint64_t{first} + count > size) {
      return member_error(path, name,
                          element(i) + "is first " + std::to_string(first) + ", count " +
                              std::to_string(count) + " (a range inside " + std::to_string(size) +
                              " elements was expected)");
    }
  }
  if (uses <= most_uses(size)) return {};
  return member_error(path, name,
                      "names " + std::to_string(uses) + " elements of " + std::to_string(size) +
                          " (at most " + std::to_string(most_uses(size)) + " were expected)");
}

Result<void> check_triangles(const SceneShapes& shapes, const std::string& path) {
  for (size_t shape = 0; shape < shapes.triangle_range.size(); ++shape) {
    const auto [first, count] = shapes.triangle_range[shape];
    const uint32_t vertices = shapes.vertex_range.empty() ? 0 : shapes.vertex_range[shape][1];
    for (size_t i = first; i < size_t{first} + count; ++i) {
      for (const uint32_t vertex : shapes.triangles[i]) {
        if (vertex < vertices) continue;
        return member_error(path, "triangles",
                            element(i) + "names vertex " + std::to_string(vertex) + " (shape " +
                                std::to_string(shape) + " has " + std::to_string(vertices) + ")");
      }
    }
  }
  return {};
}

Result<void> check_children(const SceneShapes& shapes, const std::string& path) {
  for (size_t i = 0; i < shapes.child_shape.size(); ++i) {
    const uint32_t child = shapes.child_shape[i];
    if (child >= shapes.kind.size()) {
      return member_error(path, "child_shape",
                          element(i) + "is shape " + std::to_string(child) + " (there are " +
                              std::to_string(shapes.kind.size()) + ")");
    }
    if (needs_children(shapes.kind[child])) {
      return member_error(path, "child_shape",
                          element(i) + "is shape " + std::to_string(child) +
                              ", a compound (any other kind was expected)");
    }
  }
  return {};
}

// Whether a grid may have so many samples along one side.
bool is_side(float samples) {
  const bool is_in_range = samples >= 2 && samples <= float(kMostHeightSamples);
  return is_in_range && samples == float(uint32_t(samples));
}

// Checks that grids have whole numbers of samples along their sides, and as many heights.
Result<void> check_heights(const SceneShapes& shapes, const std::string& path) {
  for (size_t i = 0; i < shapes.kind.size(); ++i) {
    if (!needs_heights(shapes.kind[i])) continue;
    const float nx = shapes.params[i][0], ny = shapes.params[i][1];
    if (!is_side(nx) || !is_side(ny)) {
      char sides[64];
      std::snprintf(sides, sizeof sides, "%.9g x %.9g", double{nx}, double{ny});
      return member_error(path, "shape_params",
                          element(i) + "is a height field of " + sides +
                              " samples (whole numbers from 2 to " +
                              std::to_string(kMostHeightSamples) + " were expected)");
    }
    const uint64_t samples = uint64_t(nx) * uint64_t(ny);
    if (shapes.height_range[i][1] == samples) continue;
    return member_error(path, "shape_height_range",
                        element(i) + "has count " + std::to_string(shapes.height_range[i][1]) +
                            " (" + std::to_string(samples) + " for " +
                            std::to_string(uint64_t(nx)) + " x " + std::to_string(uint64_t(ny)) +
                            " samples was expected)");
  }
  return {};
}

Result<void> check_roundings(const SceneShapes& shapes, const std::string& path) {
  for (size_t i = 0; i < shapes.rounding.size(); ++i) {
    const float rounding = shapes.rounding[i];
    const bool is_radius = rounding >= 0 && rounding <= FLT_MAX;
    if (is_radius && (rounding == 0 || takes_rounding(shapes.kind[i]))) continue;
    char number[32];
    std::snprintf(number, sizeof number, "%.9g", double{rounding});
    return member_error(path, "shape_radius",
                        element(i) + "is " + number +
                            (is_radius ? " for a shape of kind " + std::to_string(shapes.kind[i]) +
                                             " (0 was expected)"
                                       : " (a number >= 0 was expected)"));
  }
  return {};
}

Result<void> check_scales(const SceneShapes& shapes, const std::string& path) {
  for (size_t i = 0; i < shapes.scale.size(); ++i) {
    const auto& [x, y, z] = shapes.scale[i];
    const auto is_factor = [](float factor) { return std::isfinite(factor) && factor != 0; };
    if (is_factor(x) && is_factor(y) && is_factor(z)) continue;
    char factors[64];
    std::snprintf(factors, sizeof factors, "(%.9g, %.9g, %.9g)", double{x}, double{y}, double{z});
    return member_error(
        path, "shape_scale",
        element(i) + "is " + factors + " (finite factors other than 0 were expected)");
  }
  return {};
}

// Checks that an array has `expected` elements, or none if it may be absent.
template <class T>
Result<void> check_size(const std::string& path, const std::string& name,
                        const std::vector<T>& values, size_t expected, bool may_be_absent) {
  if (values.size() == expected || (values.empty() && may_be_absent)) return {};
  return member_error(path, name,
                      "holds " + std::to_string(values.size()) + " elements (" +
                          std::to_string(expected) + " were expected)");
}

Result<void> check_sizes(const SceneShapes& shapes, const std::string& path) {
  const size_t count = shapes.kind.size();
  const size_t children = shapes.child_shape.size();
  return first_error({
      check_size(path, "shape_params", shapes.params, count, false),
      check_size(path, "shape_vertex_range", shapes.vertex_range, count, true),
      check_size(path, "shape_triangle_range", shapes.triangle_range, count, true),
      check_size(path, "shape_child_range", shapes.child_range, count, true),
      check_size(path, "shape_height_range", shapes.height_range, count, true),
      check_size(path, "shape_radius", shapes.rounding, count, true),
      check_size(path, "shape_scale", shapes.scale, count, true),
      check_size(path, "child_position", shapes.child_position, children, false),
      check_size(path, "child_orientation", shapes.child_orientation, children, false),
  });
}
}  // namespace

bool takes_rounding(uint8_t kind) {
  switch (static_cast<ShapeKind>(kind)) {
    case ShapeKind::box:
    case ShapeKind::hull:
    case ShapeKind::cylinder:
    case ShapeKind::cone:
    case ShapeKind::ellipsoid:
      return true;
    default:
      return false;
  }
}

Result<void> check_shapes(const SceneShapes& shapes, const std::string& path) {
  Result<void> result = check_sizes(shapes, path);
  if (result) result = check_kinds(shapes, path);
  if (result) {
    result = check_ranges(shapes, path, "shape_vertex_range", shapes.vertex_range,
                          shapes.vertices.size(), needs_vertices);
  }
  if (result) {
    result = check_ranges(shapes, path, "shape_triangle_range", shapes.triangle_range,
                          shapes.triangles.size(), needs_triangles);
  }
  if (result) {
    result = check_ranges(shapes, path, "shape_child_range", shapes.child_range,
                          shapes.child_shape.size(), needs_children);
  }
  if (result) {
    result = check_ranges(shapes, path, "shape_height_range", shapes.height_range,
                          shapes.heights.size(), needs_heights);
  }
  if (result) result = check_triangles(shapes, path);
  if (result) result = check_children(shapes, path);
  if (result) result = check_heights(shapes, path);
  if (result) result = check_roundings(shapes, path);
  if (result) result = check_scales(shapes, path);
  return result;
}

Result<SceneShapes> read_shapes(const NpzReader& reader) {
  SceneShapes shapes;
  Result<std::vector<uint8_t>> kind = reader.read<uint8_t>("shape_kind", {kAny});
  if (!kind) return kind.error();
  shapes.kind = std::move(*kind);
  const uint64_t count = shapes.kind.size();
  Result<std::vector<std::array<float, 8>>> params =
      reader.read<std::array<float, 8>>("shape_params", {count});
  if (!params) return params.error();
  shapes.params = std::move(*params);

  Result<void> read = first_error({
      read_optional(reader, "shape_vertex_range", {count}, shapes.vertex_range),
      read_optional(reader, "vertices", {kAny}, shapes.vertices),
      read_optional(reader, "shape_triangle_range", {count}, shapes.triangle_range),
      read_optional(reader, "triangles", {kAny}, shapes.triangles),
      read_optional(reader, "shape_child_range", {count}, shapes.child_range),
      read_optional(reader, "child_shape", {kAny}, shapes.child_shape),
      read_optional(reader, "shape_height_range", {count}, shapes.height_range),
      read_optional(reader, "heights", {kAny}, shapes.heights),
      read_optional(reader, "shape_radius", {count}, shapes.rounding),
      read_optional(reader, "shape_scale", {count}, shapes.scale),
  });
  if (!read) return read.error();
  const uint64_t children = shapes.child_shape.size();
  if (children > 0) {
    Result<std::vector<std::array<float, 3>>> position =
        reader.read<std::array<float, 3>>("child_position", {children});
    if (!position) return position.error();
    shapes.child_position = std::move(*position);
    Result<std::vector<std::array<float, 4>>> orientation =
        reader.read<std::array<float, 4>>("child_orientation", {children});
    if (!orientation) return orientation.error();
    shapes.child_orientation = std::move(*orientation);
  }
  Result<void> checked = check_shapes(shapes, reader.path());
  if (!checked) return checked.error();
  return shapes;
}

Result<void> write_shapes(const SceneShapes& shapes, NpzWriter& writer) {
  return first_error({
      writer.add("shape_kind", shapes.kind),
      writer.add("shape_params", shapes.params),
      write_optional(writer, "shape_vertex_range", shapes.vertex_range),
      write_optional(writer, "vertices", shapes.vertices),
      write_optional(writer, "shape_triangle_range", shapes.triangle_range),
      write_optional(writer, "triangles", shapes.triangles),
      write_optional(writer, "shape_child_range", shapes.child_range),
      write_optional(writer, "child_shape", shapes.child_shape),
      write_optional(writer, "child_position", shapes.child_position),
      write_optional(writer, "child_orientation", shapes.child_orientation),
      write_optional(writer, "shape_height_range", shapes.height_range),
      write_optional(writer, "heights", shapes.heights),
      write_optional(writer, "shape_radius", shapes.rounding),
      write_optional(writer, "shape_scale", shapes.scale),
  });
}

Result<void> check_version(const NpzReader& reader, bool required) {
  if (!required && !reader.has("carom_version")) return {};
  Result<std::vector<int32_t>> version = reader.read<int32_t>("carom_version", {1});
  if (!version) return version.error();
  if (version->front() == 1) return {};
  return member_error(reader.path(), "carom_version",
                      "is " + std::to_string(version->front()) + " (1 was expected)");
}

Result<void> write_version(NpzWriter& writer) {
  return writer.add("carom_version", std::vector<int32_t>{1});
}

}  // namespace carom::io
