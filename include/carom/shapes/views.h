// Views of the caller's own arrays: pointer + stride in bytes, never copied, never owned.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "carom/export.h"
#include "carom/shapes/body.h"
#include "carom/shapes/shape.h"

namespace carom {

// Where the radius of a sphere is found.
enum class RadiusLayout : uint8_t {
  fourth,  // behind the position: records of x, y, z, r (16 bytes in float32, 32 in float64)
  column,  // in an array of its own, always float32
  none,    // points: the radius is zero
};

// Positions x, y, z of `count` bodies, float32 or float64, `stride` bytes apart. With
// RadiusLayout::fourth a fourth component of the same type follows (spheres: the radius; others:
// any finite value).
struct PositionView {
  const void* data = nullptr;
  size_t stride = 0;
  PositionType type = PositionType::float32;
  RadiusLayout radius_layout = RadiusLayout::fourth;
  const float* radius = nullptr;  // RadiusLayout::column only
  size_t radius_stride = sizeof(float);
};

// Six columns of boxes: lower and upper corners relative to the body's position, or in world
// coordinates where the positions are zero.
struct AabbColumns {
  std::array<const float*, 3> lower{};
  std::array<const float*, 3> upper{};
  size_t stride = sizeof(float);
};

// Orientations as quaternions x, y, z, w (float32), which need not be unit ones: the rotation is
// M(q) / |q|^2. Absent (data == nullptr): none is rotated.
struct OrientationView {
  const float* data = nullptr;
  size_t stride = 4 * sizeof(float);
};

// Parameters of all kinds but spheres and aabbs: rows of four floats, as many as the kind has.
//   capsule    ax ay az radius | bx by bz 0
//   box        hx hy hz 0
//   dop        13 lower ends of slabs, 13 upper ones (any finite numbers behind the last slab),
//              k (6, 14, 18 or 26), 0
//   halfspace  nx ny nz offset
//   triangle   three corners, each with a fourth number: thickness, one_sided (0 or 1), inner_edges
//              (0 to 7)
//   hull, mesh, compound  the address of the geometry in the first bytes (geometry_row()), 0 behind
//              it; the geometry must outlive the view
struct ShapeRows {
  const float* data = nullptr;
  const uint32_t* first = nullptr;  // one a body: its first row; nullptr: body i's is i * row_count
};

inline constexpr size_t kMostRows = 7;

// How many rows a body of this kind has; 0: it has none.
constexpr uint32_t row_count(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::box:
    case ShapeKind::halfspace:
    case ShapeKind::hull:
    case ShapeKind::mesh:
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

// The rows of a shape, as many as its kind has.
CAROM_EXPORT std::array<std::array<float, 4>, kMostRows> shape_rows(const Shape& shape);
// The shape of a kind that has rows. It does not own its geometry.
CAROM_EXPORT Shape shape_from_rows(ShapeKind kind, const std::array<float, 4>* rows);

// A set of bodies to test: what the narrow phase and the bounds stage read.
//   position  indexed by body; may be absent (data == nullptr) if all bodies are boxes given in
//             world coordinates
//   kind      one per body; nullptr: all are `uniform_kind`
//   box_slot  the row of `boxes` of an aabb body; nullptr: the body's own index
//   orientation, rows  of all kinds but spheres and aabbs; of mixed kinds with rows.first
struct Collidables {
  size_t count = 0;
  PositionView position;
  const ShapeKind* kind = nullptr;
  ShapeKind uniform_kind = ShapeKind::sphere;
  AabbColumns boxes;
  const uint32_t* box_slot = nullptr;
  OrientationView orientation;
  ShapeRows rows;
};

// Views of common layouts.
inline Collidables sphere_records(const float* xyzr, size_t count,
                                  size_t stride = 4 * sizeof(float)) {
  Collidables view;
  view.count = count;
  view.position = {.data = xyzr, .stride = stride};
  return view;
}

inline Collidables points(const float* xyz, size_t count, size_t stride = 3 * sizeof(float)) {
  Collidables view;
  view.count = count;
  view.position = {.data = xyz, .stride = stride, .radius_layout = RadiusLayout::none};
  return view;
}

inline Collidables world_boxes(const AabbColumns& boxes, size_t count) {
  Collidables view;
  view.count = count;
  view.uniform_kind = ShapeKind::aabb;
  view.boxes = boxes;
  return view;
}

// World bounds of bodies in six columns; a closed box. An empty box (lower = +inf, upper = -inf)
// stands for a body that takes no part.
struct BoundsView {
  std::array<const float*, 3> lower{};
  std::array<const float*, 3> upper{};
  size_t count = 0;
  size_t stride = sizeof(float);
};

}  // namespace carom
