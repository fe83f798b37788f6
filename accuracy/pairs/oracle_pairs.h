// The pairs of the oracle under the names that this folder uses.
#pragma once

#include "oracle/convex_families.h"

namespace carom::accuracy {

using oracle::ConvexFamily;
using oracle::ConvexOracle;
using oracle::ConvexPair;
using oracle::KindPair;
using oracle::Random;

// Every pair of kinds that the library has a kernel for, in the order of its list.
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
