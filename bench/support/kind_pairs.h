// The pairs of kinds that have a kernel, and some of boxes and hulls with a rounding.
#pragma once

#include "carom/shapes/shape.h"

namespace carom::bench {

struct KindPair {
  const char* name;
  ShapeKind a;
  ShapeKind b;
};

inline constexpr KindPair kKindPairs[] = {
#define CAROM_PAIR(name, kind_a, kind_b, passes) {#name, ShapeKind::kind_a, ShapeKind::kind_b},
#include "narrowphase/pairs/pair_list.inc"
#undef CAROM_PAIR
    {"sphere_rounded_box", ShapeKind::sphere, ShapeKind::rounded_box},
    {"rounded_box_triangle", ShapeKind::rounded_box, ShapeKind::triangle},
    {"rounded_box_rounded_box", ShapeKind::rounded_box, ShapeKind::rounded_box},
    {"rounded_hull_rounded_hull", ShapeKind::rounded_hull, ShapeKind::rounded_hull}};

}  // namespace carom::bench
