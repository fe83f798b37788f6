// Shapes with a rounding, and the same without it.
#pragma once

#include "carom/shapes/shape.h"

namespace carom {

// 0 for kinds that have none.
inline float rounding_of(const Shape& shape) {
  return std::visit(
      [](const auto& s) -> float {
        if constexpr (requires { s.rounding; }) return s.rounding;
        return 0;
      },
      shape);
}

inline Shape without_rounding(const Shape& shape) {
  Shape core = shape;
  std::visit(
      [](auto& s) {
        if constexpr (requires { s.rounding; }) s.rounding = 0;
      },
      core);
  return core;
}

// The order in which there are tests: that of the kinds without rounding, and of equal ones that of
// the kinds themselves.
constexpr bool comes_after(ShapeKind a, ShapeKind b) {
  return core_kind(a) != core_kind(b) ? core_kind(a) > core_kind(b) : a > b;
}

}  // namespace carom
