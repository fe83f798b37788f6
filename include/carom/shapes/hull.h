/// @file
/// Convex hulls: corners and faces. A geometry is made once, never changed, and shared by all
/// bodies of that shape.
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
#include "carom/shapes/ladder.h"

namespace carom {

class DopSolid;
class HullFeatures;

/// The points and faces of a hull in the body's frame, metres. A hull may be a point, a segment or
/// a flat polygon; it then has no faces, or two that look in opposite directions.
class CAROM_EXPORT HullGeometry {
 public:
  /// The outline of one face: a range of corners().
  struct Face {
    uint32_t first;  ///< index into corners()
    uint32_t count;  ///< >= 3
  };

  /// The points in the order in which they were given.
  std::span<const Eigen::Vector3f> points() const { return points_; }
  /// The faces in the order in which they were given.
  std::span<const Face> faces() const { return faces_; }
  /// Indices of points: the outlines of all faces, counter-clockwise as seen from outside.
  std::span<const uint32_t> corners() const { return corners_; }
  /// Indices of points: the outline of one face.
  std::span<const uint32_t> corners(const Face& face) const {
    return corners().subspan(face.first, face.count);
  }
  /// The greatest magnitude of a coordinate.
  float size() const { return size_; }
  /// The mean of the points.
  const Eigen::Vector3d& middle() const { return middle_; }
  /// The coordinates of all points along one axis (0, 1, 2), padded to a multiple of sixteen with
  /// that of the first point.
  const float* column(size_t axis) const { return columns_.get() + axis * column_stride_; }
  /// Entries from one column to the next: the number of points, padded.
  size_t column_stride() const { return column_stride_; }
  /// Two balls about middle(), which is rounded.
  struct Balls {
    std::array<float, 4> outer = {};  ///< middle and radius: all points lie in it
    float inner = 0;  ///< radius of a ball in the hull; 0 if its faces do not close a solid
  };
  /// The balls of this hull, metres, in the body's frame.
  const Balls& balls() const { return balls_; }
  /// Records x, y, z, 0 of every point, and after them of middle(), rounded to float32.
  std::span<const std::array<float, 4>> records() const { return records_; }
  /// Faces, edges (none for k-DOPs) and neighbours, if the faces close a solid with all points
  /// behind them; nullptr otherwise: then overlapping pairs of such a hull take longer. For Carom's
  /// own use.
  const HullFeatures* features() const { return features_.get(); }
  /// What a search for depths reads of the hull of a k-DOP, if it has features; nullptr for other
  /// hulls. The columns are part of it. For Carom's own use.
  const DopSolid* dop_solid() const { return dop_solid_; }

 private:
  friend struct HullBuilder;
  friend class DopGeometry;

  // Tests in lanes read these of every hull, so they lie side by side.
  static constexpr size_t kBytesOfLanes = 104;
  Balls balls_;
  float size_ = 0;
  uint32_t column_stride_ = 0;
  const DopSolid* dop_solid_ = nullptr;
  std::vector<std::array<float, 4>> records_;
  std::vector<Eigen::Vector3f> points_;
  std::shared_ptr<const float> columns_;

  std::vector<Face> faces_;
  std::vector<uint32_t> corners_;
  std::shared_ptr<const HullFeatures> features_;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
};

/// Makes a hull from the corners of a convex polytope and the outlines of its faces (indices of
/// points, counter-clockwise as seen from outside). Points that are inside, or given twice, do no
/// harm but cost time. Faces serve manifolds, the penetration directions of triangles that are
/// one-sided or have inner edges, and, if they close a solid with all points behind them, depths;
/// all else uses the points alone. Fails if there is no point, a coordinate is not finite, or a
/// face has fewer than three corners or one that does not exist.
CAROM_EXPORT Result<std::shared_ptr<const HullGeometry>> make_hull(
    std::span<const Eigen::Vector3f> points, std::span<const std::vector<uint32_t>> faces);

/// A convex hull, which turns with its body, with all points within `rounding` of it. Without
/// geometry it is not valid.
struct Hull {
  std::shared_ptr<const HullGeometry> geometry;  ///< made by make_hull(); may be shared
  LadderPtr ladder = nullptr;  ///< simpler models of it, for bodies with a tolerance; not used if
                               ///< the rounding is not 0
  float rounding = 0;          ///< metres, >= 0
};

}  // namespace carom
