#include "cli/check/convexity.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace carom::cli {

using Eigen::Vector3d;
using Eigen::Vector3f;

double ConvexPlane::excess(const Vector3d& point) const {
  const Vector3d way = point - origin;
  const double tilt = altitude > 0 ? way.norm() / altitude : 0;
  return normal.dot(way) - rounding * (2 + 2 * tilt);
}

Convexity::Convexity(std::span<const Vector3f> points) : points_(points) {
  order_.resize(points.size());
  std::iota(order_.begin(), order_.end(), 0u);
  const Block all = block(0, static_cast<uint32_t>(order_.size()));
  middle_ = all.lower + (all.upper - all.lower) / 2;
  half_step_ = all.lower.cwiseAbs().cwiseMax(all.upper.cwiseAbs()) *
               (double{std::numeric_limits<float>::epsilon()} / 2);
  // About as many blocks as points in a block.
  const double root = std::sqrt(static_cast<double>(points.size()));
  divide(0, static_cast<uint32_t>(order_.size()), static_cast<uint32_t>(root) + 16);
}

Convexity::Block Convexity::block(uint32_t begin, uint32_t end) const {
  Block box{begin, end, points_[order_[begin]].cast<double>(), {}};
  box.upper = box.lower;
  for (uint32_t i = begin; i < end; ++i) {
    const Vector3d p = points_[order_[i]].cast<double>();
    box.lower = box.lower.cwiseMin(p);
    box.upper = box.upper.cwiseMax(p);
  }
  return box;
}

// Splits points into halves along the longest axis until a block has at most `most`.
void Convexity::divide(uint32_t begin, uint32_t end, uint32_t most) {
  const Block whole = block(begin, end);
  if (end - begin <= most) {
    blocks_.push_back(whole);
    return;
  }
  Eigen::Index axis;
  (whole.upper - whole.lower).maxCoeff(&axis);
  const uint32_t half = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                   [&](uint32_t i, uint32_t j) { return points_[i][axis] < points_[j][axis]; });
  divide(begin, half, most);
  divide(half, end, most);
}

ConvexPlane Convexity::plane(const std::array<Vector3d, 3>& corners) const {
  const Vector3d u = corners[1] - corners[0];
  const Vector3d v = corners[2] - corners[0];
  const Vector3d across = u.cross(v);
  const double area = across.norm();
  const double longest = std::max({u.norm(), v.norm(), (corners[2] - corners[1]).norm()});
  ConvexPlane plane{corners[0], Vector3d::Zero(), 0, 0};
  if (!(area > 0)) return plane;
  plane.normal = across / area;
  plane.rounding = plane.normal.cwiseAbs().dot(half_step_);
  plane.altitude = area / longest;
  return plane;
}

double Convexity::volume_below(const std::array<Vector3d, 3>& corners) const {
  const Vector3d u = corners[1] - corners[0];
  const Vector3d v = corners[2] - corners[0];
  return u.cross(v).dot(corners[0] - middle_);
}

std::pair<uint32_t, double> Convexity::highest(const ConvexPlane& plane) const {
  std::pair<uint32_t, double> best = {0, 0};
  for (const Block& block : blocks_) {
    const Vector3d far = (plane.normal.array() > 0).select(block.upper, block.lower) - plane.origin;
    if (plane.normal.dot(far) <= 2 * plane.rounding + best.second) continue;
    for (uint32_t i = block.begin; i < block.end; ++i) {
      const double excess = plane.excess(points_[order_[i]].cast<double>());
      if (excess > best.second) best = {order_[i], excess};
    }
  }
  return best;
}

}  // namespace carom::cli
