// Shapes of collidables. A shape is a closed set in the body's own frame: touching is overlap.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <variant>

#include "carom/export.h"

namespace carom {

// The codes of the file format; kinds that have no kernel yet are refused by name.
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
};

inline constexpr int kShapeKindCount = 9;

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

using Shape = std::variant<Sphere, Aabb>;

}  // namespace carom
