// Surfaces of numbered triangles: meshes and height fields. Both answer the same questions.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "carom/shapes/height_field_geometry.h"
#include "carom/shapes/mesh_geometry.h"
#include "carom/shapes/shape.h"
#include "shapes/geometry_row.h"

namespace carom {

inline Eigen::Vector3f corner_of(const MeshGeometry& mesh, size_t triangle, size_t i) {
  return mesh.vertices()[mesh.triangles()[triangle][i]];
}

inline std::array<Eigen::Vector3f, 3> corners_of(const MeshGeometry& mesh, size_t triangle) {
  return {corner_of(mesh, triangle, 0), corner_of(mesh, triangle, 1), corner_of(mesh, triangle, 2)};
}
inline std::array<Eigen::Vector3f, 3> corners_of(const HeightFieldGeometry& field,
                                                 size_t triangle) {
  return field.corners(triangle);
}

inline MeshRules rules_of(const MeshGeometry& mesh) { return mesh.rules(); }
inline MeshRules rules_of(const HeightFieldGeometry& /*field*/) { return {}; }

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

// Points at one of the two.
class Surface {
 public:
  Surface(const MeshGeometry& mesh) : mesh_(&mesh) {}
  Surface(const HeightFieldGeometry& field) : field_(&field) {}

  // Returns use(the geometry).
  template <class Use>
  decltype(auto) visit(const Use& use) const {
    return mesh_ ? use(*mesh_) : use(*field_);
  }

  // nullptr: it is the other kind.
  const MeshGeometry* mesh() const { return mesh_; }
  const HeightFieldGeometry* field() const { return field_; }

  MeshRules rules() const { return mesh_ ? mesh_->rules() : MeshRules{}; }
  const Eigen::Vector3f& lower() const { return mesh_ ? mesh_->lower() : field_->lower(); }
  const Eigen::Vector3f& upper() const { return mesh_ ? mesh_->upper() : field_->upper(); }
  std::array<Eigen::Vector3f, 3> corners(size_t triangle) const {
    return mesh_ ? corners_of(*mesh_, triangle) : field_->corners(triangle);
  }
  uint8_t inner_edges(size_t triangle, bool from_front) const {
    return mesh_ ? mesh_->inner_edges(triangle, from_front)
                 : field_->inner_edges(triangle, from_front);
  }
  // One of them, by its number.
  bool is_inner_edge(size_t triangle, unsigned edge, bool from_front) const {
    return mesh_ ? (mesh_->inner_edges(triangle, from_front) >> edge & 1) != 0
                 : field_->is_inner_edge(triangle, edge, from_front);
  }
  // Numbers of the corners that all triangles with them share.
  std::array<uint32_t, 3> corner_numbers(size_t triangle) const {
    return mesh_ ? mesh_->triangles()[triangle] : field_->corner_numbers(triangle);
  }

 private:
  const MeshGeometry* mesh_ = nullptr;
  const HeightFieldGeometry* field_ = nullptr;
};

// The surface of a kind that is one; `row`: its row of parameters.
inline Surface surface_at(ShapeKind kind, const std::array<float, 4>& row) {
  if (kind == ShapeKind::mesh) return *geometry_at<MeshGeometry>(row);
  return *geometry_at<HeightFieldGeometry>(row);
}

}  // namespace carom
