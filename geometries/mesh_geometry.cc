#include "carom/shapes/mesh_geometry.h"

#include <algorithm>
#include <cfloat>
#include <string>

#include "base/float_environment.h"
#include "geometries/inner_edges.h"
#include "geometries/mesh_storage.h"
#include "geometries/part.h"
#include "geometries/shared_edges.h"
#include "geometries/triangle_measures.h"

namespace carom {
namespace {

using Eigen::Vector3f;
using Corners = std::array<uint32_t, 3>;

}  // namespace

class MeshMaker {
 public:
  MeshMaker(std::span<const Vector3f> vertices, std::span<const Corners> triangles,
            const MeshRules& rules)
      : mesh_(new MeshGeometry()), storage_(std::make_shared<MeshGeometry::Storage>()) {
    storage_->vertices.reserve(vertices.size() + 1);
    storage_->vertices.assign(vertices.begin(), vertices.end());
    storage_->vertices.push_back(Vector3f::Zero());
    storage_->triangles.assign(triangles.begin(), triangles.end());
    storage_->edges.resize(triangles.size());
    mesh_->vertices_ = std::span(storage_->vertices).first(vertices.size());
    mesh_->triangles_ = storage_->triangles;
    mesh_->edges_ = storage_->edges;
    mesh_->rules_ = rules;
    mesh_->storage_ = storage_;
  }

  std::shared_ptr<const MeshGeometry> make() {
    find_degenerate();
    find_inner_edges();
    find_boxes();
    return mesh_;
  }

 private:
  std::array<Double3, 3> corners(size_t triangle) const {
    return {corner(*mesh_, triangle, 0), corner(*mesh_, triangle, 1), corner(*mesh_, triangle, 2)};
  }

  void find_degenerate() {
    for (size_t t = 0; t < storage_->edges.size(); ++t) {
      storage_->edges[t].is_degenerate = !has_area(corners(t));
      mesh_->degenerate_count_ += storage_->edges[t].is_degenerate;
    }
  }

  void find_inner_edges() {
    for_each_shared_edge(*mesh_, [&](const TriangleEdge& edge, const TriangleEdge& other) {
      const Double3 across = corner(*mesh_, other.triangle, (other.index + 2u) % 3);
      const InnerSides inner = inner_sides(corners(edge.triangle), edge.index, across);
      const auto bit = static_cast<uint8_t>(1u << edge.index);
      MeshGeometry::Edges& edges = storage_->edges[edge.triangle];
      if (inner.from_front) edges.inner_from_front |= bit;
      if (inner.from_back) edges.inner_from_back |= bit;
    });
  }

  void find_boxes() {
    std::vector<TreeBox> boxes(mesh_->triangles_.size());
    for (size_t t = 0; t < boxes.size(); ++t) {
      const TreeBox box = box_of_triangle(corners(t), double{mesh_->rules_.thickness});
      for (int axis = 0; axis < 3; ++axis) {
        float& lower = storage_->lower[axis];
        float& upper = storage_->upper[axis];
        lower = t == 0 ? box.lower[axis] : std::min(lower, box.lower[axis]);
        upper = t == 0 ? box.upper[axis] : std::max(upper, box.upper[axis]);
      }
      boxes[t] = mesh_->is_degenerate(t) ? TreeBox{{1, 1, 1}, {-1, -1, -1}} : box;
    }
    storage_->tree = std::make_unique<BoxTree>(boxes);
    mesh_->lower_ = storage_->lower;
    mesh_->upper_ = storage_->upper;
    mesh_->tree_ = storage_->tree.get();
  }

  std::shared_ptr<MeshGeometry> mesh_;
  std::shared_ptr<MeshGeometry::Storage> storage_;
};

MeshGeometry::MeshGeometry() = default;
MeshGeometry::MeshGeometry(const MeshGeometry&) = default;
MeshGeometry::~MeshGeometry() = default;

Corners MeshGeometry::corner_numbers(size_t triangle) const {
  const auto& [a, b, c] = triangles_[triangle];
  return is_mirrored_ ? Corners{a, c, b} : Corners{a, b, c};
}

std::array<Vector3f, 3> MeshGeometry::corners(size_t triangle) const {
  const auto [a, b, c] = corner_numbers(triangle);
  return {vertex(a), vertex(b), vertex(c)};
}

size_t MeshGeometry::Storage::bytes() const {
  return sizeof *this + vertices.capacity() * sizeof(Vector3f) +
         (triangles.capacity() + across.capacity()) * sizeof(Corners) +
         edges.capacity() * sizeof(Edges) + tree->bytes();
}

size_t MeshGeometry::bytes() const { return sizeof *this + (is_scaled_ ? 0 : storage_->bytes()); }

Result<std::shared_ptr<const MeshGeometry>> make_mesh(std::span<const Vector3f> vertices,
                                                      std::span<const Corners> triangles,
                                                      const MeshRules& rules) {
  const FloatEnvironment environment;
  if (triangles.empty()) return Error{"a mesh without triangles"};
  if (triangles.size() > BoxTree::kMostItems) return Error{"a mesh of too many triangles"};
  if (!(rules.thickness >= 0 && rules.thickness <= FLT_MAX)) {
    return Error{"the thickness of the mesh is negative or not finite"};
  }
  for (size_t i = 0; i < vertices.size(); ++i) {
    if (!vertices[i].allFinite()) {
      return Error{"vertex " + std::to_string(i) + " of the mesh is not finite"};
    }
  }
  for (size_t i = 0; i < triangles.size(); ++i) {
    if (*std::max_element(triangles[i].begin(), triangles[i].end()) >= vertices.size()) {
      return Error{"triangle " + std::to_string(i) +
                   " of the mesh has a vertex that does not exist"};
    }
  }
  return MeshMaker(vertices, triangles, rules).make();
}

}  // namespace carom
