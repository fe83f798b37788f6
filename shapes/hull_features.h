// The faces and edges of a solid hull, for searches over separating axes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "carom/shapes/hull.h"

namespace carom {

// In the body's frame.
class HullFeatures {
 public:
  // From one point to the next, with these faces beside it as seen from outside.
  struct Edge {
    Eigen::Vector3f direction;  // unit; left normal x right normal has it
    uint32_t from;              // point
    uint32_t left, right;       // faces
  };

  // nullptr unless the faces are those of a solid, with all points behind them: edges in order,
  // each between two faces.
  static std::shared_ptr<const HullFeatures> of(const HullGeometry& hull);

  size_t face_count() const { return planes_.size(); }
  Eigen::Vector3f normal(size_t face) const {  // unit, outwards
    const std::array<float, 4>& plane = planes_[face];
    return {plane[0], plane[1], plane[2]};
  }
  // Of a face's plane over the origin of the body, along the normal.
  float height(size_t face) const { return planes_[face][3]; }
  // The same in columns: x, y, z of the normals, and heights, up to a multiple of sixteen; behind
  // the last, faces that lie further out than anything.
  const float* column(size_t i) const { return columns_.data() + i * columns_.size() / 4; }
  // A ball of this size around the middle of the hull lies inside of it, surely.
  float inner_radius() const { return inner_radius_; }
  std::span<const Edge> edges() const { return edges_; }
  // The faces beside each edge.
  std::span<const std::array<uint16_t, 2>> sides() const { return sides_; }

 private:
  bool add_faces(const HullGeometry& hull);
  bool add_edges(const HullGeometry& hull);

  std::vector<Edge> edges_;
  std::vector<std::array<uint16_t, 2>> sides_;
  std::vector<std::array<float, 4>> planes_;
  std::vector<float> columns_;
  float inner_radius_ = 0;
};

}  // namespace carom
