// The pairs of kinds that have a kernel.
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
};

}  // namespace carom::bench
