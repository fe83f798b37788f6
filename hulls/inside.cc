#include "hulls/inside.h"

#include <cstdint>
#include <limits>
#include <queue>

#include "carom/hulls/build_hull.h"
#include "hulls/surface.h"

namespace carom::hulls {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

// A point with its distance from the hull of the chosen points, as it was when `chosen` of them
// were chosen. It is no more than that now.
struct Candidate {
  double distance;
  uint32_t point;
  size_t chosen;

  bool operator<(const Candidate& other) const {
    return distance < other.distance || (distance == other.distance && point > other.point);
  }
};

// The sum rounds alike for the same points in the same order.
Vector3d middle_of(std::span<const Vector3f> points) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3f& p : points) sum += p.cast<double>();
  return sum / static_cast<double>(points.size());
}

}  // namespace

std::vector<bool> choose_points(std::span<const Vector3f> points, size_t count) {
  std::priority_queue<Candidate> candidates;
  const Vector3d middle = middle_of(points);
  for (uint32_t i = 0; i < points.size(); ++i) {
    candidates.push({(points[i].cast<double>() - middle).squaredNorm(), i, 0});
  }
  std::vector<bool> is_chosen(points.size(), false);
  is_chosen[candidates.top().point] = true;
  candidates.pop();
  // Distances from the middle say nothing about the hull.
  std::priority_queue<Candidate> others;
  for (; !candidates.empty(); candidates.pop()) {
    others.push({std::numeric_limits<double>::infinity(), candidates.top().point, 0});
  }
  for (size_t chosen = 1; chosen < count; ++chosen) {
    const Result<BuiltHull> hull = build_hull(select(points, is_chosen));
    const Surface surface(*hull->geometry);
    while (others.top().chosen != chosen) {
      const uint32_t point = others.top().point;
      others.pop();
      others.push({surface.distance(points[point].cast<double>()), point, chosen});
    }
    is_chosen[others.top().point] = true;
    others.pop();
  }
  return is_chosen;
}

}  // namespace carom::hulls
