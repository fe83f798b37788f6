// Convex hulls: corners and faces, made once, never changed, shared by all bodies of that shape.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "carom/base/result.h"
#include "carom/export.h"

namespace carom {

class HullFeatures;

// In the body's frame. A hull may be a point, a segment or a flat polygon: such a one has no faces,
// or two that look in opposite directions.
class CAROM_EXPORT HullGeometry {
 public:
  struct Face {
    uint32_t first;  // into corners()
    uint32_t count;  // >= 3
  };

  std::span<const Eigen::Vector3f> points() const { return points_; }
  std::span<const Face> faces() const { return faces_; }
  // Indices of points: the outlines of all faces, counter-clockwise as seen from outside.
  std::span<const uint32_t> corners() const { return corners_; }
  std::span<const uint32_t> corners(const Face& face) const {
    return corners().subspan(face.first, face.count);
  }
  float size() const { return size_; }  // the greatest magnitude of a coordinate
  const Eigen::Vector3d& middle() const { return middle_; }  // the mean of the points
  // Coordinates of all points along one axis, and behind them the first one's, up to a multiple of
  // sixteen.
  const float* column(size_t axis) const { return columns_.data() + axis * columns_.size() / 3; }
  // x, y, z, 0 of every point, and behind them of middle(), rounded.
  std::span<const std::array<float, 4>> records() const { return records_; }
  // Of a solid whose faces are in order; nullptr otherwise, which costs time where such a hull
  // overlaps another.
  const HullFeatures* features() const { return features_.get(); }

 private:
  friend CAROM_EXPORT Result<std::shared_ptr<const HullGeometry>> make_hull(
      std::span<const Eigen::Vector3f> points, std::span<const std::vector<uint32_t>> faces);

  std::vector<Eigen::Vector3f> points_;
  std::vector<Face> faces_;
  std::vector<uint32_t> corners_;
  std::vector<float> columns_;
  std::vector<std::array<float, 4>> records_;
  std::shared_ptr<const HullFeatures> features_;
  float size_ = 0;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
};

// From the corners of a convex polytope and the outlines of its faces. Points that are inside, or
// given twice, do no harm but cost time. Faces are used for manifolds, for the ways out of
// triangles that have rules, and, if they close a solid with all points behind them, for depths;
// all else knows the points alone. Fails if there is no point, a coordinate is not finite, or a
// face has fewer than three corners or one that does not exist.
CAROM_EXPORT Result<std::shared_ptr<const HullGeometry>> make_hull(
    std::span<const Eigen::Vector3f> points, std::span<const std::vector<uint32_t>> faces);

// Turns with its body. Without geometry it is not valid.
struct Hull {
  std::shared_ptr<const HullGeometry> geometry;
};

}  // namespace carom
