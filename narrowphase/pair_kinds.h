// The dispatch table of pair kinds.
#pragma once

#include <array>
#include <cstdint>

#include "carom/kernel/shape.h"
#include "narrowphase/batch.h"

namespace carom {

struct PairKind {
  ShapeKind a;
  ShapeKind b;
  void (*run)(const Batch& batch);
};

inline constexpr std::array kPairKinds = {
#define CAROM_PAIR(name, kind_a, kind_b) PairKind{ShapeKind::kind_a, ShapeKind::kind_b, run_##name},
#include "narrowphase/pair_list.inc"
#undef CAROM_PAIR
};

// Which kernel tests a against b. `flipped`: with the sides exchanged, since kernels exist for one
// order only.
struct PairKindRef {
  uint8_t index = 0xff;
  bool flipped = false;

  bool exists() const { return index != 0xff; }
};

constexpr PairKindRef find_pair_kind(ShapeKind a, ShapeKind b) {
  for (size_t i = 0; i < kPairKinds.size(); ++i) {
    const auto index = static_cast<uint8_t>(i);
    if (kPairKinds[i].a == a && kPairKinds[i].b == b) return {index, false};
    if (kPairKinds[i].a == b && kPairKinds[i].b == a) return {index, true};
  }
  return {};
}

}  // namespace carom
