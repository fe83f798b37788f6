// Decides exactly whether two shapes overlap: brute force by the oracle in 100 decimal digits.
// Shapes with float coordinates that do not touch are further from touching than the rounding of
// these digits.
#pragma once

#include "oracle/convex_families.h"
#include "oracle/digits.h"

namespace carom::oracle {

struct ExactGap {
  Digits<100> value;  // the separation
  Digits<100> doubt;  // a value up to this is rounding: the shapes touch

  bool is_overlap() const { return value <= doubt; }
};

// Tries long double first, which nearly always decides. 1e-45 allows for square roots, which lose
// half of the digits.
ExactGap exact_gap(const ConvexPair& pair);

}  // namespace carom::oracle
