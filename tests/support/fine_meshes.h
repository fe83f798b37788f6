// Meshes of many triangles, and distances between surfaces by sampling.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "carom/shapes/mesh_geometry.h"
#include "tests/support/composites.h"

namespace carom::test {

// A closed surface about the origin, of 2 n (n - 1) triangles; radius(x, y, z) of a unit direction.
template <class Radius>
Mesh ball_mesh(int n, const Radius& radius, const MeshRules& rules = {}) {
  std::vector<Eigen::Vector3f> vertices;
  Triangles triangles;
  const auto add = [&](double theta, double phi) {
    const Eigen::Vector3d d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                            std::cos(theta));
    const double r = radius(d.x(), d.y(), d.z());
    const Eigen::Vector3d p = r * d;
    vertices.push_back(p.cast<float>());
  };
  const auto count = static_cast<uint32_t>(n);
  for (int i = 1; i < n; ++i) {
    for (int j = 0; j < n; ++j) add(std::numbers::pi * i / n, 2 * std::numbers::pi * j / n);
  }
  add(0, 0);
  add(std::numbers::pi, 0);
  const uint32_t north = count * (count - 1), south = north + 1;
  for (uint32_t j = 0; j < count; ++j) {
    const uint32_t k = (j + 1) % count, last = count * (count - 2);
    triangles.push_back({north, j, k});
    triangles.push_back({south, last + k, last + j});
    for (uint32_t i = 0; i + 2 < count; ++i) {
      const uint32_t above = count * i, below = above + count;
      triangles.push_back({above + j, below + j, below + k});
      triangles.push_back({above + j, below + k, above + k});
    }
  }
  return mesh_of(vertices, triangles, rules);
}

using LongVector = Eigen::Matrix<long double, 3, 1>;

inline long double to_segment(const LongVector& p, const LongVector& a, const LongVector& b) {
  const LongVector way = b - a;
  const long double t = std::clamp(way.dot(p - a) / way.squaredNorm(), 0.0L, 1.0L);
  return (a + t * way - p).norm();
}

inline long double to_triangle(const LongVector& p, const std::array<LongVector, 3>& t) {
  const LongVector n = (t[1] - t[0]).cross(t[2] - t[0]);
  bool is_above = true;
  long double nearest = std::numeric_limits<long double>::infinity();
  for (size_t i = 0; i < 3; ++i) {
    const LongVector &a = t[i], &b = t[(i + 1) % 3];
    is_above &= n.dot((b - a).cross(p - a)) >= 0;
    nearest = std::min(nearest, to_segment(p, a, b));
  }
  return is_above ? std::min(nearest, std::fabs(n.dot(p - t[0])) / n.norm()) : nearest;
}

inline std::vector<std::array<LongVector, 3>> triangles_of(const MeshGeometry& mesh) {
  std::vector<std::array<LongVector, 3>> triangles;
  for (uint32_t i = 0; i < mesh.triangles().size(); ++i) {
    if (mesh.is_degenerate(i)) continue;
    std::array<LongVector, 3> corners;
    for (size_t k = 0; k < 3; ++k) {
      corners[k] = mesh.corners(i)[k].cast<long double>();
    }
    triangles.push_back(corners);
  }
  return triangles;
}

// The distance of the furthest of some points of one surface from all triangles of the other: a
// lower bound. Each triangle gives the points of a grid of `steps`.
inline long double sampled_distance(const MeshGeometry& from, const MeshGeometry& to, int steps) {
  const auto others = triangles_of(to);
  long double furthest = 0;
  for (const auto& [a, b, c] : triangles_of(from)) {
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        const long double u = static_cast<long double>(i) / steps,
                          v = static_cast<long double>(j) / steps;
        const LongVector p = a + u * (b - a) + v * (c - a);
        long double nearest = std::numeric_limits<long double>::infinity();
        for (const auto& triangle : others) nearest = std::min(nearest, to_triangle(p, triangle));
        furthest = std::max(furthest, nearest);
      }
    }
  }
  return furthest;
}

}  // namespace carom::test
