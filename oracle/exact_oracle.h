// Whether two shapes overlap, for the judgement of exact answers: by the oracle's brute force, in
// 100 decimal digits. Shapes of floats that touch differ from ones that do not by far more than
// the last of them.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "oracle/convex_families.h"

namespace carom::oracle {

using Digits = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>,
                                             boost::multiprecision::et_off>;

struct ExactGap {
  Digits value;  // the separation
  Digits doubt;  // below this it is rounding, and the shapes touch

  bool is_overlap() const { return value <= doubt; }
};

// In long double first, which tells almost always. Roots of a lost half of the digits included.
inline ExactGap exact_gap(const ConvexPair& pair) {
  const ConvexOracle<long double> wide = pair.oracle<long double>();
  const long double gap = wide.separation().value;
  const long double size = wide.scale() + length(wide.b.centroid()) + std::fabs(gap);
  if (std::fabs(gap) > 1e-8L * size) return {Digits(gap), Digits(0)};
  const ConvexOracle<Digits> oracle = pair.oracle<Digits>();
  return {oracle.separation().value, Digits(size) * Digits("1e-45")};
}

}  // namespace carom::oracle
