#include "shapes/dop_solid.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "base/float_environment.h"
#include "shapes/dop_polytope.h"

namespace carom {

uint8_t common_plane(DopKind kind, size_t plane) {
  // The slabs of the corners of a cube, which 18-DOPs lack, are 3 to 6.
  const bool lacks_corners = kind == DopKind::k18 && slab_of_plane(plane) >= 3;
  return static_cast<uint8_t>(lacks_corners ? plane + 8 : plane);
}

Eigen::Vector3d normal_of_dop_plane(size_t plane) {
  const auto& [x, y, z] = slab_directions(DopKind::k26)[slab_of_plane(plane)];
  return sign_of_plane(plane) * Eigen::Vector3d(x, y, z).normalized();
}

const DopDirections& DopDirections::get() {
  static const DopDirections directions;
  return directions;
}

DopDirections::DopDirections() {
  const FloatEnvironment environment;
  for (size_t left = 0; left < kDopPlanes; ++left) {
    const Eigen::Vector3d normal = normal_of_dop_plane(left);
    const Eigen::Vector3f n = normal.cast<float>();
    records_[left] = {n.x(), n.y(), n.z(), 0};
    for (size_t axis = 0; axis < 3; ++axis) columns_[axis][left] = records_[left][axis];
    for (size_t right = 0; right < kDopPlanes; ++right) {
      const bool is_parallel = slab_of_plane(left) == slab_of_plane(right);
      const Eigen::Vector3d way = normal.cross(normal_of_dop_plane(right));
      const Eigen::Vector3f d =
          is_parallel ? Eigen::Vector3f::Zero() : way.normalized().cast<float>().eval();
      edges_[left * kDopPlanes + right] = {d.x(), d.y(), d.z(), 0};
    }
  }
}

DopSolid::DopSolid(const HullGeometry& hull, float inner_radius,
                   const std::array<float, kDopPlanes>& heights, std::span<const Edge> edges)
    : middle_(hull.records()[hull.points().size()]),
      inner_radius_(inner_radius),
      edge_count_(static_cast<uint16_t>(edges.size())) {
  const auto points = hull.points();
  for (size_t i = 0; i < kMostPoints; ++i) {
    const Eigen::Vector3f& point = points[i < points.size() ? i : 0];
    for (int axis = 0; axis < 3; ++axis) points_[size_t(axis)][i] = point[axis];
  }
  heights_.fill(HUGE_VALF);
  std::copy(heights.begin(), heights.end(), heights_.begin());
  size_t planes = kDopPlanes;
  while (heights[planes - 1] == HUGE_VALF) --planes;
  plane_count_ = static_cast<uint16_t>(planes);
  for (size_t e = 0; e < edges.size(); ++e) {
    ends_[e] = static_cast<uint8_t>(edges[e].left);
    ends_[kMostEdges + e] = static_cast<uint8_t>(edges[e].right);
    ends_[2 * kMostEdges + e] = static_cast<uint8_t>(edges[e].from);
  }
}

}  // namespace carom
