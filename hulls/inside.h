// Hulls of some of the points of a hull.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace carom::hulls {

// Chooses `count` of the points: the one that is furthest from the middle and then, again and
// again, the one that is furthest from the hull of those chosen; of several the first one. Says for
// each point whether it is chosen. There are more than `count` points, and count > 0.
std::vector<bool> choose_points(std::span<const Eigen::Vector3f> points, size_t count);

// The points that are chosen (or not), in their order.
template <class Point>
std::vector<Point> select(std::span<const Point> points, const std::vector<bool>& is_chosen,
                          bool chosen = true) {
  std::vector<Point> selected;
  for (size_t i = 0; i < points.size(); ++i) {
    if (is_chosen[i] == chosen) selected.push_back(points[i]);
  }
  return selected;
}

}  // namespace carom::hulls
