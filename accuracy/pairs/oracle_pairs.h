// The oracle's pairs under this folder's names.
#pragma once

#include <algorithm>
#include <array>

#include "oracle/convex_families.h"

namespace carom::accuracy {

using oracle::ConvexFamily;
using oracle::ConvexOracle;
using oracle::ConvexPair;
using oracle::KindPair;
using oracle::Random;

struct NamedKinds {
  const char* name;
  KindPair kinds;
};

inline constexpr std::array kListedKinds = {
#define CAROM_PAIR(name, kind_a, kind_b, passes) \
  NamedKinds{#name, {ShapeKind::kind_a, ShapeKind::kind_b}},
#include "narrowphase/pairs/pair_list.inc"
#undef CAROM_PAIR
};

constexpr bool has_solution(const NamedKinds& named) {
  return !is_round(named.kinds.a) && !is_round(named.kinds.b);
}

// Every pair of kinds with a kernel that the oracle solves, in the order of the library's list.
// Those with round shapes are in round_pair.h.
inline constexpr auto kAllKinds = [] {
  std::array<NamedKinds, std::count_if(kListedKinds.begin(), kListedKinds.end(), has_solution)>
      solved{};
  std::copy_if(kListedKinds.begin(), kListedKinds.end(), solved.begin(), has_solution);
  return solved;
}();

}  // namespace carom::accuracy
