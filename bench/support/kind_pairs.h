// The pairs of kinds that have a test.
#pragma once

#include <string>
#include <vector>

#include "narrowphase/pairs/pair_kinds.h"

namespace carom::bench {

struct KindPair {
  std::string name;
  ShapeKind a;
  ShapeKind b;
};

inline std::vector<KindPair> kind_pairs() {
  std::vector<KindPair> pairs;
  for (const PairKind& kind : kPairKinds) {
    pairs.push_back({name(kind.a) + std::string("_") + name(kind.b), kind.a, kind.b});
  }
  return pairs;
}

}  // namespace carom::bench
