// The faces and edges of a solid hull, for searches over separating axes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "carom/shapes/hull.h"

namespace carom {

// Columns of points and of faces are padded to whole vectors of the widest target.
constexpr size_t padded_count(size_t count) {
  constexpr size_t kLanes = 16;
  return (count + kLanes - 1) / kLanes * kLanes;
}

// An edge from one point to the next, with the faces on either side as seen from outside.
struct HullEdge {
  uint32_t from, to;     // points
  uint32_t left, right;  // faces
};

// The edges of a hull, without those whose ends are one corner to float32: they have no direction.
// Nothing unless the faces close a solid.
std::optional<std::vector<HullEdge>> edges_of(const HullGeometry& hull);

// All vectors are in the body's frame.
class HullFeatures {
 public:
  // As HullEdge.
  struct Edge {
    Eigen::Vector4f direction;  // unit, along left normal x right normal; then 0
    uint32_t from;              // point
    uint32_t left, right;       // faces
  };

  // nullptr unless the faces bound a solid: all points lie behind every face, and each edge lies
  // between two faces that run along it in opposite directions.
  static std::shared_ptr<const HullFeatures> of(const HullGeometry& hull);
  // The same with these unit normals, one a face, and without edges.
  static std::shared_ptr<const HullFeatures> of(const HullGeometry& hull,
                                                std::span<const Eigen::Vector3d> normals);

  size_t face_count() const { return planes_.size(); }
  Eigen::Vector3f normal(size_t face) const {  // unit, outwards
    const std::array<float, 4>& plane = planes_[face];
    return {plane[0], plane[1], plane[2]};
  }
  // Height of a face's plane over the body's origin, along the normal.
  float height(size_t face) const { return planes_[face][3]; }
  // The same in columns: x, y and z of the normals, then the heights. Columns are padded to a
  // multiple of sixteen with faces of infinite height.
  const float* column(size_t i) const { return columns_.data() + i * columns_.size() / 4; }
  // The planes as records: normal, height.
  std::span<const std::array<float, 4>> planes() const { return planes_; }
  // A ball of this radius around the middle of the hull surely lies inside it.
  float inner_radius() const { return inner_radius_; }
  // Those of edges_of(); none for k-DOPs, which make theirs where they are needed.
  std::span<const Edge> edges() const { return edges_; }
  // The left faces (0) or the right faces (1) of all edges, padded to a multiple of 64. Only for
  // hulls of up to 256 faces.
  const uint8_t* sides(size_t side) const { return ends_.data() + side * side_bytes(); }
  // The points where all edges begin (0) or end (1), likewise.
  const uint8_t* ends(size_t end) const { return sides(2 + end); }
  size_t side_bytes() const { return ends_.size() / 4; }
  // The cosine of half the angle between the normals of each edge's faces; padded to a multiple of
  // sixteen.
  const float* half_cosines() const { return half_cosines_.data(); }

  size_t bytes() const;

 private:
  bool add_faces(const HullGeometry& hull, std::span<const Eigen::Vector3d> normals);
  void add_edges(const HullGeometry& hull, std::span<const HullEdge> edges);

  std::vector<Edge> edges_;
  std::vector<uint8_t> ends_;  // sides and ends of edges, in columns
  std::vector<float> half_cosines_;
  std::vector<std::array<float, 4>> planes_;
  std::vector<float> columns_;
  float inner_radius_ = 0;
};

// The memory of a hull and its features, without a DopSolid.
size_t bytes_of(const HullGeometry& hull);

}  // namespace carom
