// The geometry of meshes: triangles, what edges they share, and a tree of their boxes; made once,
// never changed, shared by all bodies of that shape.
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

// What holds of every triangle, as in Triangle (carom/shapes/shape.h).
struct MeshRules {
  bool one_sided = false;
  float thickness = 0;  // metres, >= 0
};

// In the body's frame. Triangles without area are there, but take no part in anything.
class CAROM_EXPORT MeshGeometry {
 public:
  ~MeshGeometry();

  std::span<const Eigen::Vector3f> vertices() const { return vertices_; }
  // As given: sub-shapes are named by their index.
  std::span<const std::array<uint32_t, 3>> triangles() const { return triangles_; }
  const MeshRules& rules() const { return rules_; }

  size_t degenerate_count() const { return degenerate_count_; }
  bool is_degenerate(size_t triangle) const { return edges_[triangle].is_degenerate; }

  // Bit i: the edge from corner i to the next is shared with exactly one other triangle, and the
  // surface is flat or bent inwards there, as seen from the front of the triangle or from its back.
  // Nothing that touches the mesh from that side can touch the edge alone.
  uint8_t inner_edges(size_t triangle, bool from_front) const {
    return from_front ? edges_[triangle].inner_from_front : edges_[triangle].inner_from_back;
  }

  // A box that holds all triangles with their thickness, rounded outwards.
  const Eigen::Vector3f& lower() const { return lower_; }
  const Eigen::Vector3f& upper() const { return upper_; }

  // Items are triangles.
  const BoxTree& tree() const { return *tree_; }

 private:
  struct Edges {
    uint8_t inner_from_front = 0;
    uint8_t inner_from_back = 0;
    bool is_degenerate = false;
  };

  friend class MeshMaker;
  MeshGeometry();

  std::vector<Eigen::Vector3f> vertices_;
  std::vector<std::array<uint32_t, 3>> triangles_;
  std::vector<Edges> edges_;
  MeshRules rules_;
  size_t degenerate_count_ = 0;
  Eigen::Vector3f lower_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f upper_ = Eigen::Vector3f::Zero();
  std::unique_ptr<const BoxTree> tree_;
};

// From corners and, of every triangle, the indices of three of them, counter-clockwise as seen from
// its front. Corners at the same place count as one. Fails if there is no triangle, a corner is not
// finite, an index has no corner, or the thickness is negative or not finite.
CAROM_EXPORT Result<std::shared_ptr<const MeshGeometry>> make_mesh(
    std::span<const Eigen::Vector3f> vertices, std::span<const std::array<uint32_t, 3>> triangles,
    const MeshRules& rules = {});

}  // namespace carom
