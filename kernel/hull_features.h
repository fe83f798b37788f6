// The faces and edges of a solid hull, for searches over separating axes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "carom/kernel/hull.h"

namespace carom {

// In the body's frame.
class HullFeatures {
 public:
  struct Face {
    Eigen::Vector3f normal;  // unit, outwards
    float height;            // of its plane over the origin of the body, along the normal
    uint32_t first;          // into the list of edges()
    uint32_t count;
  };
  // From one point to the next, with these faces beside it as seen from outside.
  struct Edge {
    Eigen::Vector3f direction;  // unit; left normal x right normal has it
    uint32_t from;              // point
    uint32_t left, right;       // faces
  };

  // nullptr unless the faces are those of a solid, with all points behind them: edges in order,
  // each between two faces.
  static std::shared_ptr<const HullFeatures> of(const HullGeometry& hull);

  std::span<const Face> faces() const { return faces_; }
  const Edge& edge(uint32_t i) const { return edges_[i]; }
  size_t edge_count() const { return edges_.size(); }
  // Those around a face.
  std::span<const uint32_t> edges(const Face& face) const {
    return std::span(around_).subspan(face.first, face.count);
  }

 private:
  bool add_faces(const HullGeometry& hull);
  bool add_edges(const HullGeometry& hull);

  std::vector<Face> faces_;
  std::vector<Edge> edges_;
  std::vector<uint32_t> around_;
};

}  // namespace carom
