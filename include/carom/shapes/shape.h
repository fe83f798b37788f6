// Shapes of collidables. A shape is a closed set in the body's own frame: touching is overlap.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <variant>

#include "carom/export.h"
#include "carom/shapes/compound.h"
#include "carom/shapes/dop.h"
#include "carom/shapes/hull.h"
#include "carom/shapes/mesh.h"

namespace carom {

// The codes of the file format, and `triangle`, which is a mesh of one triangle there.
enum class ShapeKind : uint8_t {
  sphere = 0,
  capsule = 1,
  aabb = 2,
  box = 3,
  dop = 4,
  hull = 5,
  mesh = 6,
  compound = 7,
  halfspace = 8,
  triangle = 9,
};

inline constexpr int kShapeKindCount = 10;

// "sphere", "capsule", ...; "unknown" for a code that is none.
CAROM_EXPORT const char* name(ShapeKind kind);

// Ball about the body's position. radius >= 0.
struct Sphere {
  float radius = 0;
};

// Box along the world axes, whatever the body's orientation: all x with
// position + lower <= x <= position + upper. lower <= upper in every axis.
struct Aabb {
  Eigen::Vector3f lower = Eigen::Vector3f::Zero();
  Eigen::Vector3f upper = Eigen::Vector3f::Zero();

  static Aabb from_half_extents(const Eigen::Vector3f& half) { return {-half, half}; }
};

// All points within `radius` of the segment from a to b, in the body's frame. radius >= 0; a == b
// is a sphere.
struct Capsule {
  Eigen::Vector3f a = Eigen::Vector3f::Zero();
  Eigen::Vector3f b = Eigen::Vector3f::Zero();
  float radius = 0;
};

// Oriented box about the body's position: |x_i| <= half_i in the body's frame. half >= 0.
struct Box {
  Eigen::Vector3f half = Eigen::Vector3f::Zero();
};

// One triangle, in the body's frame. Its front is the side from which the corners run
// counter-clockwise. Triangles without area are segments or points.
struct Triangle {
  std::array<Eigen::Vector3f, 3> corners = {Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero(),
                                            Eigen::Vector3f::Zero()};
  float thickness = 0;  // >= 0: a prism that reaches so far behind the front
  // Meets only what comes from the front. Shapes that overlap it leave by the front, too: where
  // another way would be shorter, the points that are furthest along this one need not face each
  // other, and the point on the triangle's side may lie beside it.
  bool one_sided = false;
  // Bit i: the edge from corner i to the next is inside a mesh, and contacts there keep the normal
  // of the face, as above.
  uint8_t inner_edges = 0;
};

// All x of the body's frame with normal . x <= offset. The normal need not be a unit vector, but
// not zero. Half-spaces have no bounds: they are candidates with every body that reaches into them.
struct Halfspace {
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();
  float offset = 0;
};

// A Dop (carom/shapes/dop.h) turns with its body, as a box does; its slabs must have a point in
// common.
using Shape =
    std::variant<Sphere, Aabb, Capsule, Box, Triangle, Halfspace, Dop, Hull, Mesh, Compound>;

CAROM_EXPORT ShapeKind kind_of(const Shape& shape);

// Made of parts that are shapes themselves.
constexpr bool is_composite(ShapeKind kind) {
  return kind == ShapeKind::mesh || kind == ShapeKind::compound;
}

// Kinds whose numbers lie in a geometry that bodies share.
constexpr bool has_geometry(ShapeKind kind) {
  return kind == ShapeKind::hull || is_composite(kind);
}

}  // namespace carom
