// What kinds_fuzz reads: the number of a pair of kinds, flags, then two bodies.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "carom/kernel/views.h"

namespace carom::fuzz {

struct KindPair {
  const char* name;
  ShapeKind a, b;
};

// Every pair of kinds that has a kernel.
inline constexpr KindPair kPairs[] = {
#define CAROM_PAIR(name, a, b, passes) {#name, ShapeKind::a, ShapeKind::b},
#include "narrowphase/pair_list.inc"
#undef CAROM_PAIR
};

enum Flag : uint8_t { kExchanged = 1, kFloat64 = 2 };

// Spheres: the radius is the first number of the rows; aabbs: the first two rows are the corners.
struct Body {
  std::array<std::array<float, 4>, kMostRows> rows;
  std::array<float, 4> orientation;
  std::array<double, 3> position;
};

}  // namespace carom::fuzz
