// The oracle's pairs under this folder's names.
#pragma once

#include "oracle/convex_families.h"

namespace carom::accuracy {

using oracle::ConvexFamily;
using oracle::ConvexOracle;
using oracle::ConvexPair;
using oracle::KindPair;
using oracle::Random;

// Every pair of kinds with a kernel, in the order of the library's list.
struct NamedKinds {
  const char* name;
  KindPair kinds;
};

inline constexpr NamedKinds kAllKinds[] = {
#define CAROM_PAIR(name, kind_a, kind_b, passes) {#name, {ShapeKind::kind_a, ShapeKind::kind_b}},
#include "narrowphase/pairs/pair_list.inc"
#undef CAROM_PAIR
};

}  // namespace carom::accuracy
