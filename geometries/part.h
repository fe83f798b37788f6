// Parts of bodies: simple shapes and meshes with a pose, in the numbers that the tests read.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "base/tolerances.h"
#include "carom/shapes/mesh_geometry.h"
#include "shapes/body_reader.h"
#include "shapes/turn.h"

namespace carom {

using Turn = std::array<Double3, 3>;  // rows of a rotation

inline constexpr Turn kNotTurned = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

inline Double3 plus(const Double3& a, const Double3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

inline Double3 turned(const Turn& turn, const Double3& v) {
  return {dot(turn[0], v), dot(turn[1], v), dot(turn[2], v)};
}

inline Double3 turned_back(const Turn& turn, const Double3& v) {
  return plus(plus({turn[0][0] * v[0], turn[0][1] * v[0], turn[0][2] * v[0]},
                   {turn[1][0] * v[1], turn[1][1] * v[1], turn[1][2] * v[1]}),
              {turn[2][0] * v[2], turn[2][1] * v[2], turn[2][2] * v[2]});
}

inline Double3 cross(const Double3& a, const Double3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// From so many parts on it pays to look at hulls and balls before the parts themselves.
inline constexpr size_t kManyParts = 8;

// A ball that holds a part, in its frame.
struct PartBall {
  Double3 middle{};
  double radius = -1;  // negative: none is known
};

// A shape and its pose: in the body's frame for a child of a compound, in a frame of the pair's own
// for a whole body.
struct Part {
  ShapeKind kind = ShapeKind::sphere;
  float radius = 0;                       // spheres only
  std::array<float, 3> lower{}, upper{};  // aabbs only
  std::array<Row, kMostRows> rows{};      // all other kinds
  const DopGeometry* dop = nullptr;       // of a k-DOP, if it is known
  Row orientation = {0, 0, 0, 1};
  Double3 position{};
  PartBall ball{};  // of the children of compounds that have many

  bool is_turned() const { return row_count(kind) > 0; }
  Turn turn() const { return is_turned() ? rotation_of(orientation) : kNotTurned; }
};

// A box in the part's frame that holds the part, up to rounding. Zero for half-spaces.
struct PartBox {
  Double3 middle{}, half{};
};

PartBox box_of(const Part& part);

// None for meshes, half-spaces and triangles, which may have rules that make them deeper.
PartBall ball_of(const Part& part);

// q * p as x, y, z, w, scaled by a power of two and rounded to float32. The quaternions need not be
// unit ones.
Row product(const Row& q, const Row& p);

// The world pose of a child of a body.
struct PlacedChild {
  Double3 arm;  // from the body's position to the child's
  Double3 position;
  Row orientation;
};

inline PlacedChild placed(const Part& child, const Double3& position, const Turn& turn,
                          const Row& orientation) {
  const Double3 arm = turned(turn, child.position);
  return {arm, plus(position, arm), product(orientation, child.orientation)};
}

// The middle of the part's box, in the frame in which the part's position is given.
inline Double3 middle_of(const Part& part) {
  return plus(part.position, turned(part.turn(), box_of(part).middle));
}

// Writes the three rows of a triangle of a mesh, without inner edges; corners are counted from
// `origin`. It writes straight to the destination: copying rows that were just stored as floats
// would wait for those stores.
inline void put_triangle_rows(const MeshGeometry& mesh, size_t triangle, Row* rows,
                              const std::array<float, 3>& origin = {}) {
  const float fourth[] = {mesh.rules().thickness, mesh.rules().one_sided ? 1.0f : 0.0f, 0.0f};
  for (size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3f& v = mesh.vertices()[mesh.triangles()[triangle][i]];
    rows[i] = {v.x() - origin[0], v.y() - origin[1], v.z() - origin[2], fourth[i]};
  }
}

inline Double3 corner(const MeshGeometry& mesh, size_t triangle, size_t i) {
  const Eigen::Vector3f& v = mesh.vertices()[mesh.triangles()[triangle][i]];
  return {v.x(), v.y(), v.z()};
}

// A normal towards the front of a triangle, in the mesh's frame; not a unit vector.
inline Double3 front_of(const MeshGeometry& mesh, size_t triangle) {
  const Double3 a = corner(mesh, triangle, 0);
  return cross(minus(corner(mesh, triangle, 1), a), minus(corner(mesh, triangle, 2), a));
}

// A triangle of a mesh, with the pose of the mesh.
struct PlacedTriangle {
  const MeshGeometry& mesh;
  size_t triangle;
  const Double3& position;
  Turn turn;

  // The inner edges of the triangle for a shape whose middle is at `middle`, as bits.
  uint8_t inner_edges_towards(const Double3& middle) const {
    const Double3 in_mesh = turned_back(turn, minus(middle, position));
    const Double3 way = minus(in_mesh, corner(mesh, triangle, 0));
    return mesh.inner_edges(triangle, dot(front_of(mesh, triangle), way) >= 0);
  }

  // The corners that are furthest along `way`, as bits.
  unsigned corners_towards(const Double3& way) const {
    const Double3 in_mesh = turned_back(turn, way);
    const Double3 a = corner(mesh, triangle, 0);
    const Double3 u = minus(corner(mesh, triangle, 1), a), v = minus(corner(mesh, triangle, 2), a);
    const Double3 height = {0, dot(in_mesh, u), dot(in_mesh, v)};
    const double least =
        std::max({height[0], height[1], height[2]}) - kSameHeight * (greatest(u) + greatest(v));
    unsigned corners = 0;
    for (unsigned i = 0; i < 3; ++i) corners |= (height[i] >= least ? 1u : 0u) << i;
    return corners;
  }

  // The triangle's inner edges if a shape with this middle that is pushed out along `way` would
  // cross an inner edge, or a corner between two of them; otherwise 0.
  template <class Middle>
  uint8_t edges_to_close(const Double3& way, const Middle& middle) const {
    const unsigned corners = corners_towards(way);
    if (corners == 0b111) return 0;
    const uint8_t edges = inner_edges_towards(middle());
    const auto is_inner = [&](unsigned edge) { return (edges >> edge % 3 & 1) != 0; };
    for (unsigned i = 0; i < 3; ++i) {
      const unsigned first = 1u << i, second = 1u << (i + 1) % 3;
      if (corners == (first | second) && is_inner(i)) return edges;
      if (corners == first && is_inner(i) && is_inner(i + 2)) return edges;
    }
    return 0;
  }
};

}  // namespace carom
