/// @file
/// Shapes of bodies. A shape is a closed set in the body's own frame: touching is overlap.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <variant>

#include "carom/export.h"
#include "carom/shapes/compound.h"
#include "carom/shapes/dop.h"
#include "carom/shapes/height_field.h"
#include "carom/shapes/hull.h"
#include "carom/shapes/mesh.h"

namespace carom {

/// The kinds of shapes. The values are the codes of the file format, except for `triangle`, which
/// the format stores as a mesh of one triangle, and for rounded boxes and hulls, which it stores as
/// boxes and hulls with a rounding.
enum class ShapeKind : uint8_t {
  sphere = 0,         ///< Sphere
  capsule = 1,        ///< Capsule
  aabb = 2,           ///< Aabb
  box = 3,            ///< Box
  dop = 4,            ///< Dop
  hull = 5,           ///< Hull
  mesh = 6,           ///< Mesh
  compound = 7,       ///< Compound
  halfspace = 8,      ///< Halfspace
  cylinder = 9,       ///< Cylinder
  cone = 10,          ///< Cone
  ellipsoid = 11,     ///< Ellipsoid
  height_field = 12,  ///< HeightField
  triangle = 13,      ///< Triangle
  rounded_box = 14,   ///< Box with a rounding above 0
  rounded_hull = 15,  ///< Hull with a rounding above 0
};

/// How many kinds there are.
inline constexpr int kShapeKindCount = 16;

/// "sphere", "capsule", ...; "unknown" for a value that is not a kind.
CAROM_EXPORT const char* name(ShapeKind kind);

/// A ball about the body's position.
struct Sphere {
  float radius = 0;  ///< metres, >= 0
};

/// A box along the world axes, whatever the body's orientation: all x with
/// position + lower <= x <= position + upper. lower <= upper in every axis.
struct Aabb {
  Eigen::Vector3f lower = Eigen::Vector3f::Zero();  ///< metres, relative to the position
  Eigen::Vector3f upper = Eigen::Vector3f::Zero();  ///< metres, relative to the position

  /// The box about the position with these half extents, metres.
  static Aabb from_half_extents(const Eigen::Vector3f& half) { return {-half, half}; }
};

/// All points within `radius` of the segment from a to b. a == b is a sphere.
struct Capsule {
  Eigen::Vector3f a = Eigen::Vector3f::Zero();  ///< end of the segment, body's frame, metres
  Eigen::Vector3f b = Eigen::Vector3f::Zero();  ///< other end, body's frame, metres
  float radius = 0;                             ///< metres, >= 0
};

/// An oriented box about the body's position: all points within `rounding` of those with
/// |x_i| <= half_i in the body's frame.
struct Box {
  Eigen::Vector3f half = Eigen::Vector3f::Zero();  ///< half extents, metres, >= 0
  float rounding = 0;                              ///< metres, >= 0
};

/// All points within `rounding` of those of the body's frame with x^2 + y^2 <= radius^2 and
/// |z| <= half_length. Without length these are a disc, without radius a segment.
struct Cylinder {
  float radius = 0;       ///< metres, >= 0
  float half_length = 0;  ///< metres, >= 0
  float rounding = 0;     ///< metres, >= 0
};

/// All points within `rounding` of a cone about the z axis of the body's frame: its tip is at
/// z = half_length, its base, a disc of this radius, at z = -half_length.
struct Cone {
  float radius = 0;       ///< metres, >= 0
  float half_length = 0;  ///< metres, >= 0
  float rounding = 0;     ///< metres, >= 0
};

/// All points within `rounding` of an ellipsoid about the body's position:
/// (x / a)^2 + (y / b)^2 + (z / c)^2 <= 1 for the semi-axes a, b, c. An axis of length zero makes
/// it flat.
struct Ellipsoid {
  Eigen::Vector3f semi_axes = Eigen::Vector3f::Zero();  ///< metres, >= 0
  float rounding = 0;                                   ///< metres, >= 0
};

/// One triangle. Its front is the side from which the corners run counter-clockwise. A triangle
/// without area is a segment or a point.
struct Triangle {
  /// In the body's frame, metres.
  std::array<Eigen::Vector3f, 3> corners = {Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero(),
                                            Eigen::Vector3f::Zero()};
  float thickness = 0;  ///< metres, >= 0; above 0: a prism that reaches this far behind the front
  /// True: the triangle meets only bodies that come from the front, and the penetration direction
  /// out of it is to the front, too. If another direction would be shorter, the witness points need
  /// not face each other, and the one on the triangle's side may lie beside the triangle.
  bool one_sided = false;
  /// Bit i: the edge from corner i to the next is inside a mesh. Contacts there keep the normal of
  /// the face, with the same consequence for witness points.
  uint8_t inner_edges = 0;
};

/// All x of the body's frame with normal . x <= offset. A half-space has no bounds: it makes a
/// candidate pair with every body whose bounds reach into it.
struct Halfspace {
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();  ///< outwards; not zero, need not be unit
  float offset = 0;                                   ///< metres x length of the normal
};

/// Any shape. A Dop (carom/shapes/dop.h) turns with its body, as a box does; its slabs must have a
/// point in common.
using Shape = std::variant<Sphere, Aabb, Capsule, Box, Triangle, Halfspace, Dop, Hull, Mesh,
                           Compound, Cylinder, Cone, Ellipsoid, HeightField>;

/// The kind of a shape. A box or hull whose rounding is not 0 has a kind of its own.
CAROM_EXPORT ShapeKind kind_of(const Shape& shape);

/// Whether shapes of this kind are surfaces of numbered triangles.
constexpr bool is_surface(ShapeKind kind) {
  return kind == ShapeKind::mesh || kind == ShapeKind::height_field;
}

/// Whether shapes of this kind consist of parts that are shapes themselves.
constexpr bool is_composite(ShapeKind kind) {
  return is_surface(kind) || kind == ShapeKind::compound;
}

/// Whether shapes of this kind are boxes or hulls with a rounding.
constexpr bool is_rounded(ShapeKind kind) {
  return kind == ShapeKind::rounded_box || kind == ShapeKind::rounded_hull;
}

/// The kind of a shape of this kind without its rounding.
constexpr ShapeKind core_kind(ShapeKind kind) {
  if (kind == ShapeKind::rounded_box) return ShapeKind::box;
  return kind == ShapeKind::rounded_hull ? ShapeKind::hull : kind;
}

/// Whether shapes of this kind are curved in other ways than by a radius about the hull of points.
/// Tier::exact does not decide them.
constexpr bool is_round(ShapeKind kind) {
  return kind == ShapeKind::cylinder || kind == ShapeKind::cone || kind == ShapeKind::ellipsoid;
}

/// Whether the numbers of this kind lie in a geometry that bodies may share.
constexpr bool has_geometry(ShapeKind kind) {
  return core_kind(kind) == ShapeKind::hull || is_composite(kind);
}

}  // namespace carom
