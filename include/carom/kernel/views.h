// Views of the caller's own arrays: pointer + stride in bytes, never copied, never owned.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "carom/kernel/body.h"
#include "carom/kernel/shape.h"

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

// A set of bodies to test: what the narrow phase and the bounds stage read.
//   position  indexed by body; may be absent (data == nullptr) if all bodies are boxes given in
//             world coordinates
//   kind      one per body; nullptr: all are `uniform_kind`
//   box_slot  the row of `boxes` of an aabb body; nullptr: the body's own index
struct Collidables {
  size_t count = 0;
  PositionView position;
  const ShapeKind* kind = nullptr;
  ShapeKind uniform_kind = ShapeKind::sphere;
  AabbColumns boxes;
  const uint32_t* box_slot = nullptr;
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
