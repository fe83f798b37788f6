// The pairs of kinds that have a test; of boxes and hulls with a rounding some.
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
  using enum ShapeKind;
  std::vector<KindPair> pairs;
  for (const PairKind& kind : kPairKinds) {
    const bool is_one_of_few = kind.a == kind.b || kind.a == sphere || kind.b == triangle;
    const bool has_hull = kind.a == rounded_hull || kind.b == rounded_hull;
    const bool has_rounding = is_rounded(kind.a) || is_rounded(kind.b);
    if (has_rounding && (!is_one_of_few || (has_hull && kind.a != kind.b))) continue;
    pairs.push_back({name(kind.a) + std::string("_") + name(kind.b), kind.a, kind.b});
  }
  return pairs;
}

}  // namespace carom::bench
