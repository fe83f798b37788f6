// Boxes and hulls with a rounding, by the test of their cores: the separation is that of the cores
// less the roundings, and the points move along the normal by them. Where float32 may have changed
// the sign of that, and for special triangles, double precision gives the whole answer. The kernel
// and its scalar form share this.
#pragma once

#include <array>
#include <cfloat>
#include <cmath>

#include "base/tolerances.h"
#include "carom/results/contact.h"
#include "shapes/body_reader.h"

namespace carom {

// A bound of the coordinates of a core, as kernels see it, by its rows.
inline float core_size(ShapeKind kind, const Row* rows) {
  const auto sum = [](const Row& row) {
    return (std::fabs(row[0]) + std::fabs(row[1])) + std::fabs(row[2]);
  };
  switch (core_kind(kind)) {
    case ShapeKind::capsule:
      return (sum(rows[0]) + sum(rows[1])) + rows[0][3];
    case ShapeKind::triangle:
      return ((sum(rows[0]) + sum(rows[1])) + sum(rows[2])) + rows[0][3];
    case ShapeKind::hull:
      return geometry_at<HullGeometry>(rows[0])->size();
    case ShapeKind::halfspace:
      return std::fabs(rows[0][3]) /
             std::fmax(std::fmax(std::fabs(rows[0][0]), std::fabs(rows[0][1])),
                       std::fabs(rows[0][2]));
    case ShapeKind::dop: {
      constexpr size_t kEnds = 2 * kMostSlabs;
      float greatest = 0;
      for (size_t i = 0; i < kEnds; ++i) {
        greatest = std::fmax(greatest, std::fabs(rows[i / 4][i % 4]));
      }
      return greatest;
    }
    case ShapeKind::box:
      return sum(rows[0]);
    default:  // cylinder, cone, ellipsoid
      return sum(rows[0]) + rows[0][3];
  }
}
inline float core_size_of_aabb(const std::array<float, 3>& lower,
                               const std::array<float, 3>& upper) {
  float size = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    size += std::fmax(std::fabs(lower[axis]), std::fabs(upper[axis]));
  }
  return size;
}

// Whether a test of the triangle needs to know the roundings: its rules depend on whether the
// rounded shapes overlap.
inline bool is_special_triangle(ShapeKind kind, const Row* rows) {
  return kind == ShapeKind::triangle && (rows[0][3] != 0 || rows[1][3] != 0 || rows[2][3] != 0);
}

// How a pair grows.
struct Growth {
  float a, b;  // the roundings, metres; 0 for a side without one
  float near;  // separations up to this are unsure

  Growth(float rounding_a, float rounding_b, float distance, float size_a, float size_b)
      : a(rounding_a), b(rounding_b), near(kNearTouchScaled * ((distance + size_a) + size_b)) {}

  float both() const { return a + b; }
  // False for NaN and what is beyond float32.
  bool is_sure(float separation) const {
    const float magnitude = std::fabs(separation);
    return magnitude > near && magnitude <= FLT_MAX;
  }
};

// The greatest component of a vector: of the position of B relative to A.
template <class Vector>
float distance_along_axes(const Vector& d) {
  return std::fmax(std::fmax(std::fabs(d[0]), std::fabs(d[1])), std::fabs(d[2]));
}

// Manifold points of the cores, on the surface of A's core, become those of the rounded shapes.
// None is deeper than the contact, whatever rounding did to it on the way to the cores and back.
template <class Vector>
void grow_points(ManifoldPoints& points, size_t count, const Vector& normal, float a, float b,
                 float separation) {
  for (size_t k = 0; k < count; ++k) {
    for (size_t axis = 0; axis < 3; ++axis) {
      points.point[k][axis] = points.point[k][axis] + normal[axis] * a;
    }
    // Not std::fmax(), which may return either of two zeros.
    const float grown = points.separation[k] - (a + b);
    points.separation[k] = grown < separation ? separation : grown;
  }
}

}  // namespace carom
