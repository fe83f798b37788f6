#include "hulls/outline.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace carom::hulls {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kOnEdge = 1e-12;

struct Corner {
  Vector2d at;
  uint32_t index;
};

// Whether b lies to the right of the line from a to c. If b lies between the two, it must be off
// the line by more than kOnEdge.
bool is_corner(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const Vector2d way = c - a;
  const Vector2d step = b - a;
  const double along = step.dot(way);
  const bool is_between = along >= 0 && along <= way.squaredNorm();
  const double area = step.x() * way.y() - step.y() * way.x();
  return area > (is_between ? kOnEdge * way.norm() : 0);
}

// Appends the lower chain of sorted corners to `out`, without its last corner.
template <class Iterator>
void append_chain(Iterator begin, Iterator end, std::vector<Corner>& out) {
  const size_t first = out.size();
  for (auto next = begin; next != end; ++next) {
    while (out.size() >= first + 2 && !is_corner(out[out.size() - 2].at, out.back().at, next->at)) {
      out.pop_back();
    }
    out.push_back(*next);
  }
  out.pop_back();
}

}  // namespace

std::vector<uint32_t> outline(std::span<const Vector3d> points, std::span<const uint32_t> indices,
                              const Vector3d& normal) {
  if (indices.size() < 3) return {indices.begin(), indices.end()};
  Eigen::Index up;
  normal.cwiseAbs().maxCoeff(&up);
  const Eigen::Index x = (up + 1) % 3;
  const Eigen::Index y = (up + 2) % 3;
  std::vector<Corner> corners;
  corners.reserve(indices.size());
  for (const uint32_t i : indices) corners.push_back({{points[i][x], points[i][y]}, i});
  std::sort(corners.begin(), corners.end(), [](const Corner& p, const Corner& q) {
    return p.at.x() < q.at.x() || (p.at.x() == q.at.x() && p.at.y() < q.at.y());
  });
  std::vector<Corner> chain;
  append_chain(corners.begin(), corners.end(), chain);
  append_chain(corners.rbegin(), corners.rend(), chain);
  std::vector<uint32_t> polygon;
  polygon.reserve(chain.size());
  for (const Corner& corner : chain) polygon.push_back(corner.index);
  if (normal[up] < 0) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

Vector3d area_vector(std::span<const Vector3d> points, std::span<const uint32_t> corners) {
  Vector3d sum = Vector3d::Zero();
  for (size_t i = 2; i < corners.size(); ++i) {
    const Vector3d& first = points[corners[0]];
    sum += (points[corners[i - 1]] - first).cross(points[corners[i]] - first);
  }
  return sum;
}

}  // namespace carom::hulls
