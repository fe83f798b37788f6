/// @file
/// Views of the caller's own arrays: pointer + stride in bytes, never copied, never owned.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "carom/export.h"
#include "carom/shapes/body.h"
#include "carom/shapes/shape.h"

namespace carom {

/// Where a view has the radius of a sphere.
enum class RadiusLayout : uint8_t {
  fourth,  ///< behind the position: records of x, y, z, r (16 bytes in float32, 32 in float64)
  column,  ///< in an array of its own, always float32
  none,    ///< points: the radius is zero
};

/// Positions of bodies: records of x, y, z in the world frame, metres. With RadiusLayout::fourth a
/// fourth component of the same type follows (the radius of a sphere; any finite value for other
/// kinds).
struct PositionView {
  const void* data = nullptr;                         ///< float or double, as `type` says
  size_t stride = 0;                                  ///< bytes from one record to the next
  PositionType type = PositionType::float32;          ///< the type of the numbers
  RadiusLayout radius_layout = RadiusLayout::fourth;  ///< where the radii are
  const float* radius = nullptr;                      ///< RadiusLayout::column only; metres
  size_t radius_stride = sizeof(float);               ///< bytes, RadiusLayout::column only
};

/// Six columns of boxes: lower and upper corners relative to the body's position, or in world
/// coordinates where the positions are zero; metres.
struct AabbColumns {
  std::array<const float*, 3> lower{};  ///< lower ends in x, y and z
  std::array<const float*, 3> upper{};  ///< upper ends in x, y and z
  size_t stride = sizeof(float);        ///< bytes from one entry to the next, in all columns
  /// Whether the columns lie in records of eight floats: lower x, y, z and any number, upper x, y,
  /// z and any number (box_records()). Kernels then read a box at once, which is much faster if
  /// boxes are many and pairs lie anywhere among them.
  bool are_records = false;
};

/// The corners in records of eight floats, one after another: lower x, y, z and any number, upper
/// x, y, z and any number. Records that start at a multiple of 32 bytes are read fastest.
inline AabbColumns box_records(const float* corners) {
  return {.lower = {corners, corners + 1, corners + 2},
          .upper = {corners + 4, corners + 5, corners + 6},
          .stride = 8 * sizeof(float),
          .are_records = true};
}

/// Orientations as quaternions x, y, z, w, which need not be unit ones: the rotation from the
/// body's frame to the world is M(q) / |q|^2.
struct OrientationView {
  const float* data = nullptr;        ///< nullptr: no body is rotated
  size_t stride = 4 * sizeof(float);  ///< bytes from one quaternion to the next
};

/// Parameters of all kinds but spheres and aabbs: rows of four floats, as many as row_count() says.
/// - capsule: ax ay az radius | bx by bz 0
/// - box: hx hy hz 0; rounded_box: hx hy hz rounding
/// - cylinder, cone: radius half_length 0 rounding
/// - ellipsoid: a b c rounding
/// - dop: 13 lower ends of slabs, 13 upper ones (any finite numbers behind the last slab),
///   k (6, 14, 18 or 26), 0
/// - halfspace: nx ny nz offset
/// - triangle: three corners, each with a fourth number: thickness, one_sided (0 or 1), inner_edges
///   (0 to 7)
/// - hull, mesh, height_field, compound: the address of the geometry in the first bytes
///   (shape_rows() writes it), then 0; the geometry must outlive the view
/// - rounded_hull: as hull; the fourth number is the rounding
struct ShapeRows {
  const float* data = nullptr;  ///< dense rows
  /// The first row of each body, one entry a body; nullptr: body i starts at row i * row_count().
  const uint32_t* first = nullptr;
};

/// The greatest number of rows that a kind has.
inline constexpr size_t kMostRows = 7;

/// How many rows a body of this kind has; 0 for spheres and aabbs.
constexpr uint32_t row_count(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::box:
    case ShapeKind::rounded_box:
    case ShapeKind::cylinder:
    case ShapeKind::cone:
    case ShapeKind::ellipsoid:
    case ShapeKind::halfspace:
    case ShapeKind::hull:
    case ShapeKind::rounded_hull:
    case ShapeKind::mesh:
    case ShapeKind::height_field:
    case ShapeKind::compound:
      return 1;
    case ShapeKind::capsule:
      return 2;
    case ShapeKind::triangle:
      return 3;
    case ShapeKind::dop:
      return 7;
    default:
      return 0;
  }
}

/// The rows of a shape; those that its kind does not have are zero.
CAROM_EXPORT std::array<std::array<float, 4>, kMostRows> shape_rows(const Shape& shape);
/// The shape with these rows (row_count(kind) of them). It does not own its geometry.
CAROM_EXPORT Shape shape_from_rows(ShapeKind kind, const std::array<float, 4>* rows);

/// A set of bodies to test: the arrays that the narrow phase and the bounds stage read. All arrays
/// are indexed by body unless they say otherwise.
struct Collidables {
  size_t count = 0;  ///< bodies
  /// May be absent (data == nullptr) if all bodies are aabbs given in world coordinates.
  PositionView position;
  const ShapeKind* kind = nullptr;             ///< one a body; nullptr: all are `uniform_kind`
  ShapeKind uniform_kind = ShapeKind::sphere;  ///< the kind of all bodies if `kind` is nullptr
  AabbColumns boxes;                           ///< of aabb bodies
  const uint32_t* box_slot = nullptr;  ///< row of `boxes` of each aabb; nullptr: the body's index
  OrientationView orientation;         ///< of all kinds but spheres and aabbs
  ShapeRows rows;  ///< of all kinds but spheres and aabbs; bodies of several kinds need rows.first
  /// The geometry of each k-DOP (dop_geometry()), one entry a body: nullptr for other kinds, and
  /// allowed for any. Where it is missing, or found from other slabs than the body has, it is found
  /// anew at every use.
  const DopGeometry* const* dops = nullptr;
};

/// Spheres in records of x, y, z, radius (float32, world frame, metres), `stride` bytes apart.
inline Collidables sphere_records(const float* xyzr, size_t count,
                                  size_t stride = 4 * sizeof(float)) {
  Collidables view;
  view.count = count;
  view.position = {.data = xyzr, .stride = stride};
  return view;
}

/// Points in records of x, y, z (float32, world frame, metres), `stride` bytes apart: spheres of
/// radius zero.
inline Collidables points(const float* xyz, size_t count, size_t stride = 3 * sizeof(float)) {
  Collidables view;
  view.count = count;
  view.position = {.data = xyz, .stride = stride, .radius_layout = RadiusLayout::none};
  return view;
}

/// Aabbs in world coordinates, without positions.
inline Collidables world_boxes(const AabbColumns& boxes, size_t count) {
  Collidables view;
  view.count = count;
  view.uniform_kind = ShapeKind::aabb;
  view.boxes = boxes;
  return view;
}

/// World bounds of bodies in six columns: closed boxes, world frame, metres. A body that takes no
/// part has an empty box (lower = +inf, upper = -inf).
struct BoundsView {
  std::array<const float*, 3> lower{};  ///< lower ends in x, y and z
  std::array<const float*, 3> upper{};  ///< upper ends in x, y and z
  size_t count = 0;                     ///< bodies
  size_t stride = sizeof(float);        ///< bytes from one entry to the next, in all columns
};

}  // namespace carom
