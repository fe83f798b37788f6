// Which points are in front of planes, by more than rounding may do.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace carom::cli {

// The plane of a triangle whose corners are rounded to float32.
struct ConvexPlane {
  Eigen::Vector3d origin;
  Eigen::Vector3d normal;  // unit
  double rounding;         // by which a corner may be off along the normal
  double altitude;         // the least of the triangle

  // How far a point is in front, less what it may be in front of the plane before rounding:
  // corners that are off tilt the plane.
  double excess(const Eigen::Vector3d& point) const;
};

class Convexity {
 public:
  // The points must be finite, and outlive this. There is at least one.
  explicit Convexity(std::span<const Eigen::Vector3f> points);

  ConvexPlane plane(const std::array<Eigen::Vector3d, 3>& corners) const;
  // Six times the volume between the triangle and the middle of all points: negative if its front
  // looks there.
  double volume_below(const std::array<Eigen::Vector3d, 3>& corners) const;
  // The point with the largest excess, if one has more than 0, and that excess.
  std::pair<uint32_t, double> highest(const ConvexPlane& plane) const;

 private:
  // Points that are near each other.
  struct Block {
    uint32_t begin;
    uint32_t end;
    Eigen::Vector3d lower;
    Eigen::Vector3d upper;
  };

  void divide(uint32_t begin, uint32_t end, uint32_t most);
  Block block(uint32_t begin, uint32_t end) const;

  std::span<const Eigen::Vector3f> points_;
  std::vector<uint32_t> order_;
  std::vector<Block> blocks_;
  Eigen::Vector3d middle_;
  Eigen::Vector3d half_step_;  // of a float at the largest coordinate of each axis
};

}  // namespace carom::cli
