#include "reference/simple_parts.h"

#include <algorithm>

#include "carom/shapes/compound_geometry.h"
#include "geometries/surface.h"

namespace carom::reference {
namespace {

Part part_of(const Shape& shape, const Double3& position, const Row& orientation) {
  Part part;
  part.kind = kind_of(shape);
  part.position = position;
  part.rows = shape_rows(shape);
  part.orientation = orientation;
  if (const auto* sphere = std::get_if<Sphere>(&shape)) part.radius = sphere->radius;
  if (const auto* box = std::get_if<Aabb>(&shape)) {
    std::copy_n(box->lower.data(), 3, part.lower.begin());
    std::copy_n(box->upper.data(), 3, part.upper.begin());
  }
  return part;
}

Triangle triangle_of(const Surface& surface, size_t i) {
  return {surface.corners(i), surface.rules().thickness, surface.rules().one_sided};
}

Simple triangle_part(const Simple& whole, const Surface& surface, size_t i) {
  Simple part = whole;
  part.shape = triangle_of(surface, i);
  part.placed = part_of(part.shape, whole.placed.position, whole.placed.orientation);
  part.order += i;
  part.surface = surface;
  part.triangle = i;
  return part;
}

template <class Geometry>
void add_triangles(const Simple& whole, const Geometry& geometry, std::vector<Simple>& parts) {
  for_each_triangle(geometry,
                    [&](size_t i) { parts.push_back(triangle_part(whole, geometry, i)); });
}

// Adds the parts of a body, or of a child of one. `whole` is its shape in its place.
void add_parts(const Simple& whole, std::vector<Simple>& parts) {
  if (const auto* mesh = std::get_if<Mesh>(&whole.shape)) {
    add_triangles(whole, *mesh->geometry, parts);
  } else if (const auto* field = std::get_if<HeightField>(&whole.shape)) {
    add_triangles(whole, *field->geometry, parts);
  } else if (const auto* compound = std::get_if<Compound>(&whole.shape)) {
    const Part& body = whole.placed;
    for (uint32_t i = 0; i < compound->geometry->parts().size(); ++i) {
      const Part& child = compound->geometry->parts()[i];
      const PlacedChild pose =
          placed(child, body.position, rotation_of(body.orientation), body.orientation);
      Simple part;
      part.shape = child.kind == ShapeKind::sphere ? Shape(Sphere{child.radius})
                                                   : shape_from_rows(child.kind, child.rows.data());
      part.placed = part_of(part.shape, pose.position, pose.orientation);
      part.arm = pose.arm;
      part.order = uint64_t{i} << 32;
      add_parts(part, parts);
    }
  } else {
    parts.push_back(whole);
  }
}

}  // namespace

std::vector<Simple> parts_of(const Shape& shape, const Double3& position,
                             const Eigen::Quaternionf& orientation) {
  const Eigen::Vector4f& q = orientation.coeffs();
  Simple whole;
  whole.shape = shape;
  whole.placed = part_of(shape, position, {q.x(), q.y(), q.z(), q.w()});
  std::vector<Simple> parts;
  add_parts(whole, parts);
  const bool by_child = kind_of(shape) == ShapeKind::compound;
  for (Simple& part : parts) {
    part.sub = static_cast<uint32_t>(by_child ? part.order >> 32 : part.order);
  }
  return parts;
}

}  // namespace carom::reference
