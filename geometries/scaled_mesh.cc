#include <algorithm>
#include <string>
#include <vector>

#include "base/float_environment.h"
#include "carom/shapes/scaled.h"
#include "geometries/inner_edges.h"
#include "geometries/mesh_storage.h"
#include "geometries/part.h"
#include "geometries/scale.h"
#include "geometries/shared_edges.h"
#include "geometries/triangle_measures.h"

namespace carom {

class ScaledMeshMaker {
 public:
  // `scale`: of the vertices.
  ScaledMeshMaker(const MeshGeometry& source, const Eigen::Vector3f& scale)
      : mesh_(new MeshGeometry(source)) {
    mesh_->scale_ = scale;
    mesh_->is_scaled_ = scale != Eigen::Vector3f::Ones();
    mesh_->is_mirrored_ = is_mirroring(scale);
  }

  Result<std::shared_ptr<const MeshGeometry>> make() {
    MeshGeometry& mesh = *mesh_;
    if (!mesh.is_scaled_) {
      mesh.lower_ = mesh.storage_->lower;
      mesh.upper_ = mesh.storage_->upper;
      return std::shared_ptr<const MeshGeometry>(mesh_);
    }
    for (size_t i = 0; i < mesh.vertices_.size(); ++i) {
      if (mesh.vertex(i).allFinite()) continue;
      return Error{"vertex " + std::to_string(i) + " of the mesh leaves the range of float32 by " +
                   "the scale " + text_of_scale(mesh.scale_)};
    }
    if (!set_bounds()) return unshared(mesh);  // in which other triangles are without area
    find_across(mesh);
    return std::shared_ptr<const MeshGeometry>(mesh_);
  }

 private:
  // False if a triangle loses its area.
  bool set_bounds() {
    MeshGeometry& mesh = *mesh_;
    for (size_t t = 0; t < mesh.triangles_.size(); ++t) {
      const auto [a, b, c] = mesh.corners(t);
      const std::array<Double3, 3> corners = {wide(a), wide(b), wide(c)};
      if (!mesh.is_degenerate(t) && !has_area(corners)) return false;
      const TreeBox box = box_of_triangle(corners, double{mesh.rules_.thickness});
      for (int axis = 0; axis < 3; ++axis) {
        float &lower = mesh.lower_[axis], &upper = mesh.upper_[axis];
        lower = t == 0 ? box.lower[axis] : std::min(lower, box.lower[axis]);
        upper = t == 0 ? box.upper[axis] : std::max(upper, box.upper[axis]);
      }
    }
    return true;
  }

  static void find_across(const MeshGeometry& mesh) {
    MeshGeometry::Storage& storage = *mesh.storage_;
    std::call_once(storage.is_across_known, [&] {
      constexpr uint32_t kNone = MeshGeometry::Storage::kNoVertex;
      storage.across.assign(storage.triangles.size(), {kNone, kNone, kNone});
      for_each_shared_edge(mesh, [&](const TriangleEdge& own, const TriangleEdge& other) {
        storage.across[own.triangle][own.index] =
            storage.triangles[other.triangle][(other.index + 2u) % 3];
      });
    });
  }

  std::shared_ptr<MeshGeometry> mesh_;
};

// The corners of a mirrored triangle are 0, 2, 1, so that its edges are 2, 1, 0.
bool MeshGeometry::is_scaled_inner_edge(size_t triangle, unsigned edge, bool from_front) const {
  const uint32_t across = storage_->across[triangle][is_mirrored_ ? 2 - edge : edge];
  if (across == Storage::kNoVertex) return false;
  const auto [a, b, c] = corners(triangle);
  const InnerSides inner = inner_sides({wide(a), wide(b), wide(c)}, edge, wide(vertex(across)));
  return from_front ? inner.from_front : inner.from_back;
}

uint8_t MeshGeometry::scaled_inner_edges(size_t triangle, bool from_front) const {
  unsigned edges = 0;
  for (unsigned i = 0; i < 3; ++i) {
    edges |= is_scaled_inner_edge(triangle, i, from_front) ? 1u << i : 0;
  }
  return static_cast<uint8_t>(edges);
}

Result<std::shared_ptr<const MeshGeometry>> scaled(const std::shared_ptr<const MeshGeometry>& mesh,
                                                   const Eigen::Vector3f& scale) {
  const FloatEnvironment environment;
  if (!mesh) return Error{"a mesh without geometry"};
  Result<Eigen::Vector3f> both = scale_after(mesh->scale(), scale);
  if (!both) return both.error();
  if (*both == mesh->scale()) return mesh;
  return ScaledMeshMaker(*mesh, *both).make();
}

Result<std::shared_ptr<const MeshGeometry>> unshared(const MeshGeometry& mesh) {
  std::vector<Eigen::Vector3f> vertices;
  for (size_t i = 0; i < mesh.vertices().size(); ++i) vertices.push_back(mesh.vertex(i));
  std::vector<std::array<uint32_t, 3>> triangles;
  for (size_t t = 0; t < mesh.triangles().size(); ++t) triangles.push_back(mesh.corner_numbers(t));
  return make_mesh(vertices, triangles, mesh.rules());
}

}  // namespace carom
