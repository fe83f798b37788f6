// Finds points in front of planes by more than float32 rounding explains.
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
  double rounding;         // bound of a corner's error along the normal
  double altitude;         // the least altitude of the triangle

  // How far a point is in front of the plane beyond rounding. Errors of the corners also tilt the
  // plane, so the allowance grows with the distance from the triangle.
  double excess(const Eigen::Vector3d& point) const;
};

class Convexity {
 public:
  // There must be at least one point, all finite; they must outlive this object.
  explicit Convexity(std::span<const Eigen::Vector3f> points);

  ConvexPlane plane(const std::array<Eigen::Vector3d, 3>& corners) const;
  // Six times the volume of the tetrahedron of the triangle and the middle of all points; negative
  // if the triangle's front faces the middle.
  double volume_below(const std::array<Eigen::Vector3d, 3>& corners) const;
  // The point with the largest excess and that excess; the excess is 0 if no point has more.
  std::pair<uint32_t, double> highest(const ConvexPlane& plane) const;

 private:
  // A group of points near each other, with its box.
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
  Eigen::Vector3d half_step_;  // half a float step at the largest coordinate of each axis
};

}  // namespace carom::cli
