/// @file
/// The geometry of meshes: triangles, the edges that they share, and a tree of their boxes. It is
/// made once, never changed, and shared by all bodies of that shape.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "carom/base/result.h"
#include "carom/export.h"
#include "carom/shapes/mesh.h"

namespace carom {

class BoxTree;

/// The properties that all triangles of a mesh have, as in Triangle (carom/shapes/shape.h).
struct MeshRules {
  bool one_sided = false;  ///< meets only bodies in front of it
  float thickness = 0;     ///< metres behind the front, >= 0
};

/// The triangles of a mesh, metres. Triangles without area keep their index, but no test uses them.
/// A mesh that scaled() made (carom/shapes/scaled.h) shares the vertices, the triangles and the
/// tree of another one, and has a scale.
class CAROM_EXPORT MeshGeometry {
 public:
  ~MeshGeometry();
  MeshGeometry& operator=(const MeshGeometry&) = delete;

  /// The vertices in the order in which they were given. Times scale() they are those of the body's
  /// frame.
  std::span<const Eigen::Vector3f> vertices() const { return vertices_; }
  /// Three vertex indices a triangle, in the order in which they were given; sub-shape indices
  /// refer to it. If scale() mirrors, they run clockwise as seen from the front.
  std::span<const std::array<uint32_t, 3>> triangles() const { return triangles_; }
  /// The factors of vertices() along the axes of the body's frame; (1, 1, 1) unless scaled() made
  /// this mesh.
  const Eigen::Vector3f& scale() const { return scale_; }
  /// Whether a factor of scale() is not 1.
  bool is_scaled() const { return is_scaled_; }
  /// Vertex `index`, in the body's frame.
  Eigen::Vector3f vertex(size_t index) const { return vertices_[index].cwiseProduct(scale_); }
  /// The corners of a triangle in the body's frame, counter-clockwise as seen from its front.
  std::array<Eigen::Vector3f, 3> corners(size_t triangle) const;
  /// The numbers of the same corners in vertices().
  std::array<uint32_t, 3> corner_numbers(size_t triangle) const;
  /// The properties of all triangles.
  const MeshRules& rules() const { return rules_; }

  /// How many triangles have no area.
  size_t degenerate_count() const { return degenerate_count_; }
  /// Whether this triangle has no area.
  bool is_degenerate(size_t triangle) const { return edges_[triangle].is_degenerate; }

  /// Bit i: the edge from corner i to the next is shared with exactly one other triangle, and the
  /// surface is flat or bent inwards there, as seen from the front of the triangle or from its
  /// back. A body that touches the mesh from that side cannot touch the edge alone. Corners are
  /// those of corners().
  uint8_t inner_edges(size_t triangle, bool from_front) const {
    if (is_scaled_) return scaled_inner_edges(triangle, from_front);
    return from_front ? edges_[triangle].inner_from_front : edges_[triangle].inner_from_back;
  }
  /// One of them: that from corner `edge` to the next.
  bool is_inner_edge(size_t triangle, unsigned edge, bool from_front) const {
    if (is_scaled_) return is_scaled_inner_edge(triangle, edge, from_front);
    return (inner_edges(triangle, from_front) >> edge & 1) != 0;
  }

  /// Lower corner of a box that contains all triangles with their thickness, rounded outwards.
  const Eigen::Vector3f& lower() const { return lower_; }
  /// Upper corner of the same box.
  const Eigen::Vector3f& upper() const { return upper_; }

  /// Memory of this geometry in bytes; that of a mesh with a scale without what it shares.
  size_t bytes() const;

  /// The tree of the triangles' boxes, before the scale; its items are triangles. For Carom's own
  /// use.
  const BoxTree& tree() const { return *tree_; }

 private:
  struct Edges {
    uint8_t inner_from_front = 0;
    uint8_t inner_from_back = 0;
    bool is_degenerate = false;
  };
  struct Storage;  // what meshes share that differ in their scale alone

  friend class MeshMaker;
  friend class ScaledMeshMaker;
  MeshGeometry();
  MeshGeometry(const MeshGeometry&);  // shares the storage

  uint8_t scaled_inner_edges(size_t triangle, bool from_front) const;
  bool is_scaled_inner_edge(size_t triangle, unsigned edge, bool from_front) const;

  // One more number follows the last vertex, so that lanes may read four each.
  std::span<const Eigen::Vector3f> vertices_;
  std::span<const std::array<uint32_t, 3>> triangles_;
  std::span<const Edges> edges_;  // of triangles without a scale
  MeshRules rules_;
  bool is_scaled_ = false;
  bool is_mirrored_ = false;
  size_t degenerate_count_ = 0;
  Eigen::Vector3f lower_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f upper_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f scale_ = Eigen::Vector3f::Ones();
  const BoxTree* tree_ = nullptr;
  std::shared_ptr<Storage> storage_;
};

/// Makes a mesh from vertices and three vertex indices a triangle, counter-clockwise as seen from
/// its front. Vertices at the same place count as one. Fails if there is no triangle, a vertex is
/// not finite, an index has no vertex, or the thickness is negative or not finite.
CAROM_EXPORT Result<std::shared_ptr<const MeshGeometry>> make_mesh(
    std::span<const Eigen::Vector3f> vertices, std::span<const std::array<uint32_t, 3>> triangles,
    const MeshRules& rules = {});

}  // namespace carom
