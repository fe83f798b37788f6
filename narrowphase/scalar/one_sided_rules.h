// One-sided triangle rules: the penetration directions that the front and the inner edges of a
// triangle allow.
#pragma once

#include <array>
#include <cstdint>

#include "base/tolerances.h"
#include "narrowphase/scalar/vector.h"

namespace carom::scalar {

using Eigen::Vector3d;

// The rules of one triangle, in world axes.
struct FrontRules {
  Vector3d front = Vector3d::Zero();   // unit normal; zero: no area, so no rules
  Vector3d corner = Vector3d::Zero();  // the first corner
  std::array<Vector3d, 2> sides;       // from `corner` to the other corners
  double thickness = 0;
  bool one_sided = false;
  uint8_t inner_edges = 0;

  // Whether the rules forbid some directions.
  bool close_ways() const { return one_sided || inner_edges > 0; }
};

// `middle`: of the other shape. One that lies behind the back of a one-sided triangle never
// touches.
inline bool comes_from_behind(const FrontRules& rules, const Vector3d& middle) {
  return rules.one_sided &&
         dot(rules.front, Vector3d(middle - rules.corner)) < -rules.thickness - kInPlane;
}

// The corners furthest along `way`, as bits; ties within rounding included.
inline unsigned corners_towards(const FrontRules& rules, const Vector3d& way) {
  const double height[] = {0, dot(way, rules.sides[0]), dot(way, rules.sides[1])};
  const double size = largest_component(rules.sides[0]) + largest_component(rules.sides[1]);
  const double least = max(max(height[0], height[1]), height[2]) - kInPlane * size;
  unsigned corners = 0;
  for (unsigned i = 0; i < 3; ++i) corners |= (height[i] >= least ? 1u : 0u) << i;
  return corners;
}

// Whether the other shape may leave the triangle along `way`: not to the back of a one-sided
// triangle, and not over an inner edge or over a corner between two of them.
inline bool allows(const FrontRules& rules, const Vector3d& way) {
  if (rules.one_sided && dot(rules.front, way) < -kInPlane) return false;
  if (rules.inner_edges == 0) return true;
  const auto is_inner = [&](unsigned edge) { return (rules.inner_edges >> edge % 3 & 1) != 0; };
  switch (corners_towards(rules, way)) {
    case 0b111:
      return true;
    case 0b011:
      return !is_inner(0);
    case 0b110:
      return !is_inner(1);
    case 0b101:
      return !is_inner(2);
    case 0b001:
      return !(is_inner(0) && is_inner(2));
    case 0b010:
      return !(is_inner(1) && is_inner(0));
    default:
      return !(is_inner(2) && is_inner(1));
  }
}

}  // namespace carom::scalar
