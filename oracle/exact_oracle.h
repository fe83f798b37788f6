// Decides exactly whether two shapes overlap: brute force by the oracle in 100 decimal digits.
// Shapes with float coordinates that do not touch are further from touching than the rounding of
// these digits.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "oracle/convex_families.h"

namespace carom::oracle {

using Digits = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>,
                                             boost::multiprecision::et_off>;

struct ExactGap {
  Digits value;  // the separation
  Digits doubt;  // a value up to this is rounding: the shapes touch

  bool is_overlap() const { return value <= doubt; }
};

// Tries long double first, which nearly always decides. 1e-45 allows for square roots, which lose
// half of the digits.
inline ExactGap exact_gap(const ConvexPair& pair) {
  const ConvexOracle<long double> wide = pair.oracle<long double>();
  const long double gap = wide.separation().value;
  const long double size = wide.scale() + length(wide.b.centroid()) + std::fabs(gap);
  if (std::fabs(gap) > 1e-8L * size) return {Digits(gap), Digits(0)};
  const ConvexOracle<Digits> oracle = pair.oracle<Digits>();
  return {oracle.separation().value, Digits(size) * Digits("1e-45")};
}

}  // namespace carom::oracle
