/// @file
/// The geometry of meshes: triangles, the edges that they share, and a tree of their boxes. It is
/// made once, never changed, and shared by all bodies of that shape.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

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

/// The triangles of a mesh in the body's frame, metres. Triangles without area keep their index,
/// but no test uses them.
class CAROM_EXPORT MeshGeometry {
 public:
  ~MeshGeometry();

  /// The vertices in the order in which they were given.
  std::span<const Eigen::Vector3f> vertices() const {
    return {vertices_.data(), vertices_.size() - 1};
  }
  /// Three vertex indices a triangle, in the order in which they were given; sub-shape indices
  /// refer to it.
  std::span<const std::array<uint32_t, 3>> triangles() const { return triangles_; }
  /// The properties of all triangles.
  const MeshRules& rules() const { return rules_; }

  /// How many triangles have no area.
  size_t degenerate_count() const { return degenerate_count_; }
  /// Whether this triangle has no area.
  bool is_degenerate(size_t triangle) const { return edges_[triangle].is_degenerate; }

  /// Bit i: the edge from corner i to the next is shared with exactly one other triangle, and the
  /// surface is flat or bent inwards there, as seen from the front of the triangle or from its
  /// back. A body that touches the mesh from that side cannot touch the edge alone.
  uint8_t inner_edges(size_t triangle, bool from_front) const {
    return from_front ? edges_[triangle].inner_from_front : edges_[triangle].inner_from_back;
  }

  /// Lower corner of a box that contains all triangles with their thickness, rounded outwards.
  const Eigen::Vector3f& lower() const { return lower_; }
  /// Upper corner of the same box.
  const Eigen::Vector3f& upper() const { return upper_; }

  /// The tree of the triangles' boxes; its items are triangles. For Carom's own use.
  const BoxTree& tree() const { return *tree_; }

 private:
  struct Edges {
    uint8_t inner_from_front = 0;
    uint8_t inner_from_back = 0;
    bool is_degenerate = false;
  };

  friend class MeshMaker;
  MeshGeometry();

  std::vector<Eigen::Vector3f> vertices_;  // and one more, so that lanes may read four numbers each
  std::vector<std::array<uint32_t, 3>> triangles_;
  std::vector<Edges> edges_;
  MeshRules rules_;
  size_t degenerate_count_ = 0;
  Eigen::Vector3f lower_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f upper_ = Eigen::Vector3f::Zero();
  std::unique_ptr<const BoxTree> tree_;
};

/// Makes a mesh from vertices and three vertex indices a triangle, counter-clockwise as seen from
/// its front. Vertices at the same place count as one. Fails if there is no triangle, a vertex is
/// not finite, an index has no vertex, or the thickness is negative or not finite.
CAROM_EXPORT Result<std::shared_ptr<const MeshGeometry>> make_mesh(
    std::span<const Eigen::Vector3f> vertices, std::span<const std::array<uint32_t, 3>> triangles,
    const MeshRules& rules = {});

}  // namespace carom
