// Splits bodies into simple shapes in their places.
#pragma once

#include <optional>
#include <vector>

#include "carom/shapes/body.h"
#include "geometries/part.h"

namespace carom::reference {

// A shape that has no parts.
struct Simple {
  Shape shape;
  Part placed;                     // the same shape with its pose, as numbers
  Double3 arm{};                   // from the body's position to the part's
  uint64_t order = 0;              // the child, and the triangle of a surface
  uint32_t sub = 0;                // the sub-shape that results report
  std::optional<Surface> surface;  // whose triangle it is
  size_t triangle = 0;

  Pose pose() const {
    const Row& q = placed.orientation;
    return {Eigen::Vector3d(placed.position[0], placed.position[1], placed.position[2]),
            Eigen::Quaternionf(q[3], q[0], q[1], q[2])};
  }
  carom::PlacedTriangle placed_triangle() const {
    return {*surface, triangle, placed.position, rotation_of(placed.orientation)};
  }
};

// A simple shape has itself as its only part. Triangles of a mesh that have no area are left out.
std::vector<Simple> parts_of(const Shape& shape, const Double3& position,
                             const Eigen::Quaternionf& orientation);

}  // namespace carom::reference
