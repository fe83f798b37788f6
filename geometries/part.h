// Parts of bodies: simple shapes and surfaces with a pose, in the numbers that the tests read.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "base/tolerances.h"
#include "geometries/surface.h"
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
  std::array<Row, kMostRows> rows;        // all other kinds; those that the kind has are set
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

// None for surfaces, half-spaces and triangles, which may have rules that make them deeper.
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

// Writes the three rows of a triangle, without inner edges; corners are counted from `origin`.
// `surface`: as Surface::visit() hands it over. It writes straight to the destination: copying rows
// that were just stored as floats would wait for those stores.
template <class Geometry>
void put_visited_triangle(const Geometry& surface, size_t triangle, Row* rows,
                          const std::array<float, 3>& origin = {}) {
  const MeshRules rules = rules_of(surface);
  const float fourth[] = {rules.thickness, rules.one_sided ? 1.0f : 0.0f, 0.0f};
  const std::array<Eigen::Vector3f, 3> corners = corners_of(surface, triangle);
  for (size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3f& v = corners[i];
    rows[i] = {v.x() - origin[0], v.y() - origin[1], v.z() - origin[2], fourth[i]};
  }
}
// The same for all surfaces but meshes without a scale.
void put_triangle_of_others(const Surface& surface, size_t triangle, Row* rows,
                            const std::array<float, 3>& origin);
inline void put_triangle_rows(const Surface& surface, size_t triangle, Row* rows,
                              const std::array<float, 3>& origin = {}) {
  if (const MeshGeometry* mesh = surface.plain_mesh()) {
    return put_visited_triangle(*mesh, triangle, rows, origin);
  }
  put_triangle_of_others(surface, triangle, rows, origin);
}

inline Double3 wide(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }

inline Double3 corner(const MeshGeometry& mesh, size_t triangle, size_t i) {
  return wide(corner_of(mesh, triangle, i));
}

inline std::array<Double3, 3> wide_corners(const Surface& surface, size_t triangle) {
  const auto [a, b, c] = surface.corners(triangle);
  return {wide(a), wide(b), wide(c)};
}

// A triangle of a surface, with the pose of the surface.
struct PlacedTriangle {
  Surface surface;
  size_t triangle;
  const Double3& position;
  Turn turn;

  // Whether a place is on the front side of the corners.
  bool is_before(const std::array<Double3, 3>& its_corners, const Double3& place) const {
    const auto& [a, b, c] = its_corners;
    const Double3 front = cross(minus(b, a), minus(c, a));  // not a unit vector
    const Double3 way = minus(turned_back(turn, minus(place, position)), a);
    return dot(front, way) >= 0;
  }

  // The corners that are furthest along `way`, as bits.
  unsigned corners_towards(const std::array<Double3, 3>& its_corners, const Double3& way) const {
    const Double3 own_way = turned_back(turn, way);
    const auto& [a, b, c] = its_corners;
    const Double3 u = minus(b, a), v = minus(c, a);
    const Double3 height = {0, dot(own_way, u), dot(own_way, v)};
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
    const std::array<Double3, 3> its_corners = wide_corners(surface, triangle);
    const unsigned corners = corners_towards(its_corners, way);
    if (corners == 0b111) return 0;
    const bool from_front = is_before(its_corners, middle());
    const auto is_inner = [&](unsigned edge) {
      return surface.is_inner_edge(triangle, edge % 3, from_front);
    };
    bool is_over_edge = false;
    for (unsigned i = 0; i < 3; ++i) {
      const unsigned first = 1u << i, second = 1u << (i + 1) % 3;
      is_over_edge |= corners == (first | second) && is_inner(i);
      is_over_edge |= corners == first && is_inner(i) && is_inner(i + 2);
    }
    return is_over_edge ? surface.inner_edges(triangle, from_front) : uint8_t{0};
  }
};

}  // namespace carom
