// Surfaces of numbered triangles: meshes and height fields. Both answer the same questions, with a
// scale as well.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "carom/shapes/height_field_geometry.h"
#include "carom/shapes/mesh_geometry.h"
#include "carom/shapes/shape.h"
#include "shapes/geometry_row.h"

namespace carom {

// These two read triangles as they are without a scale.
inline Eigen::Vector3f corner_of(const MeshGeometry& mesh, size_t triangle, size_t i) {
  return mesh.vertices()[mesh.triangles()[triangle][i]];
}

inline std::array<Eigen::Vector3f, 3> corners_of(const MeshGeometry& mesh, size_t triangle) {
  return {corner_of(mesh, triangle, 0), corner_of(mesh, triangle, 1), corner_of(mesh, triangle, 2)};
}
inline std::array<Eigen::Vector3f, 3> corners_of(const HeightFieldGeometry& field,
                                                 size_t triangle) {
  return field.grid_corners(triangle);
}

inline MeshRules rules_of(const MeshGeometry& mesh) { return mesh.rules(); }
inline MeshRules rules_of(const HeightFieldGeometry& /*field*/) { return {}; }

// A mesh or a height field with a scale, whose corners are multiplied when they are asked for.
template <class Geometry>
struct Scaled {
  const Geometry& geometry;
};

template <class Geometry>
std::array<Eigen::Vector3f, 3> corners_of(const Scaled<Geometry>& surface, size_t triangle) {
  return surface.geometry.corners(triangle);
}
template <class Geometry>
MeshRules rules_of(const Scaled<Geometry>& surface) {
  return rules_of(surface.geometry);
}

// Calls use(its number) for every triangle that is part of the surface.
template <class Use>
void for_each_triangle(const MeshGeometry& mesh, const Use& use) {
  for (size_t i = 0; i < mesh.triangles().size(); ++i) {
    if (!mesh.is_degenerate(i)) use(i);
  }
}
template <class Use>
void for_each_triangle(const HeightFieldGeometry& field, const Use& use) {
  size_t lower = 0;  // of the cell
  for (uint32_t j = 0; j < field.cells_y(); ++j) {
    for (uint32_t i = 0; i < field.cells_x(); ++i, lower += 2) {
      if (field.is_hole(i, j)) continue;
      use(lower);
      use(lower + 1);
    }
  }
}

// Points at one of the two, with or without a scale.
class Surface {
 public:
  Surface(const MeshGeometry& mesh)
      : geometry_(&mesh), form_(mesh.is_scaled() ? Form::scaled_mesh : Form::mesh) {}
  Surface(const HeightFieldGeometry& field)
      : geometry_(&field), form_(field.is_scaled() ? Form::scaled_field : Form::field) {}

  // Returns use(the geometry): a MeshGeometry, a HeightFieldGeometry, or a Scaled one of these.
  template <class Use>
  decltype(auto) visit(const Use& use) const {
    if (form_ == Form::mesh) return use(its_mesh());
    if (form_ == Form::field) return use(its_field());
    return visit_scaled(use);
  }

  bool is_scaled() const { return form_ >= Form::scaled_mesh; }
  const Eigen::Vector3f& scale() const {
    return is_mesh() ? its_mesh().scale() : its_field().scale();
  }
  // nullptr: it is a height field, or has a scale.
  const MeshGeometry* plain_mesh() const { return form_ == Form::mesh ? &its_mesh() : nullptr; }

  MeshRules rules() const { return is_mesh() ? its_mesh().rules() : MeshRules{}; }
  const Eigen::Vector3f& lower() const {
    return is_mesh() ? its_mesh().lower() : its_field().lower();
  }
  const Eigen::Vector3f& upper() const {
    return is_mesh() ? its_mesh().upper() : its_field().upper();
  }
  std::array<Eigen::Vector3f, 3> corners(size_t triangle) const {
    return form_ == Form::mesh ? corners_of(its_mesh(), triangle) : corners_of_others(triangle);
  }
  uint8_t inner_edges(size_t triangle, bool from_front) const {
    return is_mesh() ? its_mesh().inner_edges(triangle, from_front)
                     : its_field().inner_edges(triangle, from_front);
  }
  // One of them, by its number.
  bool is_inner_edge(size_t triangle, unsigned edge, bool from_front) const {
    return is_mesh() ? its_mesh().is_inner_edge(triangle, edge, from_front)
                     : its_field().is_inner_edge(triangle, edge, from_front);
  }
  // Numbers of the corners that all triangles with them share.
  std::array<uint32_t, 3> corner_numbers(size_t triangle) const {
    return is_mesh() ? its_mesh().corner_numbers(triangle) : its_field().corner_numbers(triangle);
  }

 private:
  enum class Form : uint8_t { mesh, field, scaled_mesh, scaled_field };

  // Apart, so that callers stay small: compilers inline less in files that grow.
  std::array<Eigen::Vector3f, 3> corners_of_others(size_t triangle) const;
  template <class Use>
  [[gnu::noinline]] std::invoke_result_t<const Use&, const MeshGeometry&> visit_scaled(
      const Use& use) const {
    return form_ == Form::scaled_mesh ? use(Scaled<MeshGeometry>{its_mesh()})
                                      : use(Scaled<HeightFieldGeometry>{its_field()});
  }

  bool is_mesh() const { return form_ == Form::mesh || form_ == Form::scaled_mesh; }
  const MeshGeometry& its_mesh() const { return *static_cast<const MeshGeometry*>(geometry_); }
  const HeightFieldGeometry& its_field() const {
    return *static_cast<const HeightFieldGeometry*>(geometry_);
  }

  const void* geometry_;
  Form form_;
};

// The surface of a kind that is one; `row`: its row of parameters.
inline Surface surface_at(ShapeKind kind, const std::array<float, 4>& row) {
  if (kind == ShapeKind::mesh) return *geometry_at<MeshGeometry>(row);
  return *geometry_at<HeightFieldGeometry>(row);
}

}  // namespace carom
